#include "motion.h"

#include "karinui/base/number.h"
#include "karinui/session/scene_of.h"
#include "karinui/view/picture.h"
#include "word_table.h"

namespace karinui::app {

namespace {

constexpr std::array<const char*, kOpenEdges.size()> kEdgeKeys{"neck_mm", "waist_mm", "hem_mm", "cuff_mm"};
constexpr int kWide = 480, kHigh = 640;  // pixels of a picture
constexpr int kColumns = 4;

std::string percent(double share) { return fixed(share * 100, 1) + " %"; }
std::string kilopascals(double pascals) { return fixed(pascals / 1000, 2) + " kPa"; }
std::string slidWords(std::optional<double> metres) {
  return metres ? (*metres >= 0.0005 ? "+" : "") + fixed(*metres * 1000, 0) + " mm" : "–";
}

}  // namespace

std::string motionWords(const std::vector<FitInPose>& fits, const Console& console) {
  const auto said = [&](const Message& words) { return console.said(words); };
  WordTable table;
  std::vector<std::string> head{said(say("Pose")), said(say("Stretch, mean")),  said(say("99 %")),
                                said(say("most")), said(say("Pressure, mean")), said(say("99 %"))};
  for (const OpenEdge edge : kOpenEdges) head.push_back(said(openEdgeSaid(edge)));
  table.row(head);
  bool unsettled = false;
  for (const FitInPose& fit : fits) {
    const auto share = [&](double value) { return fit.refused ? "–" : percent(value); };
    std::vector<std::string> row{said(fit.said) + (fit.settled || fit.refused ? "" : " *"),
                                 share(fit.strain.mean),
                                 share(fit.strain.p99),
                                 share(fit.strain.max),
                                 fit.pressure ? kilopascals(fit.pressure->mean) : "–",
                                 fit.pressure ? kilopascals(fit.pressure->p99) : "–"};
    for (const auto& slid : fit.slid) row.push_back(slidWords(slid));
    table.row(row);
    unsettled = unsettled || (!fit.settled && !fit.refused);
  }
  std::string words = said(say("Fit in motion; how far open edges slide over the skin, up or towards the trunk:")) +
                      "\n" + table.words(2);
  if (unsettled) words += said(say("* did not come to rest in this pose.")) + "\n";
  for (const FitInPose& fit : fits)
    if (fit.refused) words += said(*fit.refused) + "\n";
  return words;
}

Json motionJson(const std::vector<FitInPose>& fits) {
  Json all = Json::array();
  for (const FitInPose& fit : fits) {
    if (fit.refused) {
      all.push_back({{"pose", fit.name}, {"settled", false}, {"refused", text(*fit.refused)}});
      continue;
    }
    Json one = {{"pose", fit.name},
                {"settled", fit.settled},
                {"strain_mean", fit.strain.mean},
                {"strain_p99", fit.strain.p99},
                {"strain_max", fit.strain.max}};
    if (fit.pressure)
      one["pressure_mean_kpa"] = fit.pressure->mean / 1000, one["pressure_p99_kpa"] = fit.pressure->p99 / 1000;
    Json slid = Json::object();
    for (std::size_t k = 0; k < fit.slid.size(); ++k)
      if (fit.slid[k]) slid[kEdgeKeys[k]] = *fit.slid[k] * 1000;
    one["slid"] = std::move(slid);
    all.push_back(std::move(one));
  }
  return {{"poses", all}};
}

Result<Image> motionSheet(OpenDocument& opened, const std::vector<FitInPose>& fits) {
  const auto picture = Picture::open();
  if (!picture) return picture.error();
  const Prints prints = opened.prints();
  std::vector<SheetItem> items;
  for (const FitInPose& fit : fits) {
    if (fit.refused) continue;
    const Result<SceneFrame> frame = sceneOf(fit.document, fit.body.get(), prints);
    if (!frame) return frame.error();
    Image both(2 * kWide, kHigh);
    for (const View view : {View::Front, View::Oblique}) {
      PictureOptions options;
      options.view = view, options.width = kWide, options.height = kHigh, options.lettering = false;
      const Result<Image> image = (*picture)->draw(*frame, options);
      if (!image) return image.error();
      both.paste(*image, view == View::Front ? 0 : kWide, 0);
    }
    items.push_back({std::move(both), opened.program().console.said(fit.said)});
  }
  std::vector<Message> notes;
  Result<Image> sheet = contactSheet(items, {.columns = kColumns / 2}, &notes);
  for (const Message& note : notes) opened.program().console.note(note);
  return sheet;
}

}  // namespace karinui::app
