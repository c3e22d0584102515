#include "pictures.h"

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "karinui/session/table_frame_of.h"
#include "karinui/view/line_up.h"
#include "karinui/view/table_picture.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

constexpr double kWhole = 2 * std::numbers::pi;

void tell(OpenDocument& opened, const std::vector<Message>& notes) {
  for (const Message& note : notes) opened.program().console.note(note);
}

Result<Image> fittingPicture(OpenDocument& opened, PictureOptions options, const ViewCut& cut) {
  const Result<SeenGarment> garment = seen(opened, opened.document(), cut, options.map);
  if (!garment) return garment.error();
  const auto picture = Picture::open();
  if (!picture) return picture.error();
  options.mapTop = garment->mapTop;
  Result<Image> image = (*picture)->draw(garment->frame, options);
  tell(opened, (*picture)->notes());
  return image;
}

Result<Image> comparison(OpenDocument& opened, const PictureRequest& request, PictureOptions options,
                         const ViewCut& cut) {
  const Result<Compared> all = compared(opened, request.compare, cut, options.map);
  if (!all) return all.error();
  options.mapTop = all->mapTop;
  LineUp lineUp(all->figures, all->frames, options);
  const Token& token = opened.program().console.token();
  Result<Image> image =
      request.turns > 0 ? lineUp.turns(request.turns, token) : lineUp.draw(0, columnsOf(all->figures.size()), token);
  tell(opened, lineUp.notes());
  return image;
}

// Programs that make films of pictures want even sides.
Image even(Image image) {
  if (image.width % 2 == 0 && image.height % 2 == 0) return image;
  Image wider(image.width + image.width % 2, image.height + image.height % 2, image.at(0, 0));
  wider.paste(image, 0, 0);
  return wider;
}

Done emptyFolder(const fs::path& folder) {
  std::error_code trouble;
  fs::create_directories(folder, trouble);
  if (!fs::is_directory(folder, trouble))
    return storageError(say("“{0}” could not be made a folder for the pictures.", folder.string()));
  if (fs::is_empty(folder, trouble)) return {};
  return refused(say("“{0}” is not empty; choose a new folder for the pictures.", folder.string()));
}

Result<Image> tablePicture(OpenDocument& opened, const PictureOptions& options, const PictureRequest& request) {
  const SnapshotPtr garment = snapshotOf(opened.document(), nullptr, opened.prints());
  TableLayout layout;
  layout.arrange(*garment);
  TableFrameOptions shown;
  shown.language = options.language;
  shown.nest = request.nest;
  shown.scans = request.scans;
  std::vector<Message> notes;
  Result<Image> image =
      drawTable(tableFrameOf(*garment, layout, {}, shown), {options.width, options.height, options.language}, &notes);
  tell(opened, notes);
  return image;
}

}  // namespace

Done checkPicture(const PictureRequest& request) {
  if (const auto options = pictureOptions(request, request.several()); !options) return options.error();
  const auto cut = viewCutNamed(request.hide, request.section);
  return cut ? Done() : Done(cut.error());
}

Result<Image> pictureOf(OpenDocument& opened, const PictureRequest& request) {
  Result<PictureOptions> options = pictureOptions(request, request.several());
  if (!options) return options.error();
  if (request.table) return tablePicture(opened, *options, request);
  const Result<ViewCut> cut = viewCutNamed(request.hide, request.section);
  if (!cut) return cut.error();
  return request.several() ? comparison(opened, request, *options, *cut) : fittingPicture(opened, *options, *cut);
}

Result<std::array<int, 2>> writeFrames(OpenDocument& opened, const PictureRequest& request, const std::string& folder) {
  Result<PictureOptions> options = pictureOptions(request, request.several());
  if (!options) return options.error();
  const Result<ViewCut> cut = viewCutNamed(request.hide, request.section);
  if (!cut) return cut.error();
  if (const Done empty = emptyFolder(folder); !empty) return empty.error();
  const Result<Compared> all = compared(opened, request.compare, *cut, options->map);
  if (!all) return all.error();
  options->mapTop = all->mapTop;
  LineUp lineUp(all->figures, all->frames, *options);
  lineUp.keepAll();
  const Token& token = opened.program().console.token();
  std::array<int, 2> size{};
  for (int k = 0; k < request.frames; ++k) {
    const double share = static_cast<double>(k) / request.frames;
    token.progress(share, say("picture {0} of {1}", k + 1, request.frames));
    Result<Image> image = lineUp.draw(kWhole * share, columnsOf(all->figures.size()), token);
    if (!image) return image.error();
    if (k == 0) tell(opened, lineUp.notes());
    const Image frame = even(*std::move(image));
    size = {frame.width, frame.height};
    const std::string number = std::to_string(k + 1);
    const std::string name = "frame_" + std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number + ".png";
    if (const Done done = writePng((fs::path(folder) / name).string(), frame); !done) return done.error();
  }
  return size;
}

}  // namespace karinui::app
