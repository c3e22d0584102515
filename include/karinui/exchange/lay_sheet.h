#pragma once
// A lay plan drawn at true size: the cloth with its pieces, one fabric below the other. Pure; any thread.
#include <string>
#include <string_view>

#include "karinui/design/lay_plan.h"
#include "karinui/exchange/sheet.h"

namespace karinui {

struct LayPaper {
  std::string title = "Karinui";
  PaperKind paper = PaperKind::OneSheet;  // of a PDF
  double overlap = 0.010;                 // metres by which its pages are glued
  Language language = Language::English;
};
inline constexpr std::string_view kLayEndings[] = {"pdf", "svg", "dxf", "plt"};

// `ending`: one of kLayEndings. On one sheet a PDF has a page for each fabric, and more where the cloth is longer than
// 5 m. DXF has plain lines in place on the layers of the trade; PLT (HPGL) has them for plotters.
Result<std::string> writeLay(const LayPlan& plan, std::string_view ending, const LayPaper& paper = {});

// "cotton: 1.32 m of 150 cm, 78.3 % used", a sentence for each fabric.
std::vector<Message> laySaid(const LayPlan& plan);

}  // namespace karinui
