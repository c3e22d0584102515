#include "karinui/view/lettering.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "view/utf8.h"

namespace karinui {
namespace {

// Where Debian and other houses keep their fonts: Latin first, then Japanese.
const char* const kUsualFonts[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/opentype/ipafont-gothic/ipagp.ttf",
    "/usr/share/fonts/opentype/ipafont-gothic/ipag.ttf",
    "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/google-noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/truetype/vlgothic/VL-PGothic-Regular.ttf",
    "/usr/share/fonts/truetype/takao-gothic/TakaoPGothic.ttf",
    "/usr/share/fonts/truetype/fonts-japanese-gothic.ttf",
};

}  // namespace

struct Lettering::Fonts {
  FT_Library library = nullptr;
  std::vector<FT_Face> faces;
  bool saidNoFont = false, saidMissing = false;
  std::vector<Message> notes;

  explicit Fonts(const std::vector<std::string>& files) {
    if (FT_Init_FreeType(&library) != 0) {
      library = nullptr;
      return;
    }
    for (const std::string& file : files) {
      FT_Face face = nullptr;
      if (FT_New_Face(library, file.c_str(), 0, &face) == 0) faces.push_back(face);
    }
  }
  ~Fonts() {
    for (FT_Face face : faces) FT_Done_Face(face);
    if (library) FT_Done_FreeType(library);
  }

  // Calls visit(face, glyph, pen x) for every letter that a font knows, gives the end of the line.
  template <class Visit>
  double lay(std::string_view utf8, double sizePx, Visit&& visit) {
    if (faces.empty()) {
      if (!saidNoFont && !utf8.empty())
        notes.push_back(say(
            "No font was found, so the picture carries no words; install fonts-dejavu-core and fonts-ipafont-gothic."));
      saidNoFont = true;
      return 0;
    }
    for (FT_Face face : faces) FT_Set_Char_Size(face, 0, static_cast<FT_F26Dot6>(std::lround(sizePx * 64)), 72, 72);
    double pen = 0;
    for (const char32_t letter : lettersOf(utf8)) {
      FT_Face chosen = nullptr;
      FT_UInt glyph = 0;
      for (FT_Face face : faces) {
        glyph = FT_Get_Char_Index(face, letter);
        if (glyph != 0) {
          chosen = face;
          break;
        }
      }
      if (!chosen) {
        chosen = faces.front();  // its glyph 0, the empty box, shows that something is missing
        if (!saidMissing)
          notes.push_back(
              say("No font here knows some letters of “{0}”; for Japanese install fonts-ipafont-gothic.", utf8));
        saidMissing = true;
      }
      if (FT_Load_Glyph(chosen, glyph, FT_LOAD_NO_HINTING) != 0) continue;
      visit(chosen, pen);
      pen += static_cast<double>(chosen->glyph->linearHoriAdvance) / 65536;
    }
    return pen;
  }
};

Lettering::Lettering()
    : Lettering([] {
        std::vector<std::string> there;
        std::error_code ignored;
        for (const char* file : kUsualFonts)
          if (std::filesystem::exists(file, ignored)) there.emplace_back(file);
        return there;
      }()) {}
Lettering::Lettering(const std::vector<std::string>& fontFiles) : fonts_(std::make_unique<Fonts>(fontFiles)) {}
Lettering::~Lettering() = default;
Lettering::Lettering(Lettering&&) noexcept = default;
Lettering& Lettering::operator=(Lettering&&) noexcept = default;

double Lettering::width(std::string_view utf8, double sizePx) {
  return fonts_->lay(utf8, sizePx, [](FT_Face, double) {});
}

void Lettering::write(Image& image, std::string_view utf8, double x, double y, double sizePx, Pixel colour) {
  fonts_->lay(utf8, sizePx, [&](FT_Face face, double pen) {
    // Places letters to a quarter of a pixel: even spacing at small sizes.
    const double at = x + pen;
    const double whole = std::floor(at);
    FT_Vector shift{static_cast<FT_Pos>(std::lround((at - whole) * 4) * 16), 0};
    FT_Outline_Translate(&face->glyph->outline, shift.x, 0);
    if (FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL) != 0) return;
    const FT_Bitmap& bits = face->glyph->bitmap;
    if (bits.pixel_mode != FT_PIXEL_MODE_GRAY) return;
    const int left = static_cast<int>(whole) + face->glyph->bitmap_left;
    const int top = static_cast<int>(std::lround(y)) - face->glyph->bitmap_top;
    for (int row = 0; row < static_cast<int>(bits.rows); ++row)
      for (int col = 0; col < static_cast<int>(bits.width); ++col) {
        const int px = left + col, py = top + row;
        if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
        const int ink = bits.buffer[row * bits.pitch + col] * colour[3] / 255;
        Pixel p = image.at(px, py);
        for (std::size_t c = 0; c < 3; ++c)
          p[c] = static_cast<std::uint8_t>((p[c] * (255 - ink) + colour[c] * ink + 127) / 255);
        image.set(px, py, p);
      }
  });
}

std::vector<Message> Lettering::takeNotes() {
  fonts_->saidNoFont = fonts_->saidMissing = false;
  return std::exchange(fonts_->notes, {});
}

}  // namespace karinui
