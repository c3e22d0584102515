#include "karinui/body/sizes.h"

#include <algorithm>

#include "body/plain_name.h"

namespace karinui {
namespace {

constexpr BuiltInSize kJisWomen[] = {
    {"jis5ar", "5AR", 0.77, 0.58, 0.87, 1.58},   {"jis7ar", "7AR", 0.80, 0.61, 0.89, 1.58},
    {"jis9ar", "9AR", 0.83, 0.64, 0.91, 1.58},   {"jis11ar", "11AR", 0.86, 0.67, 0.93, 1.58},
    {"jis13ar", "13AR", 0.89, 0.70, 0.95, 1.58}, {"jis15ar", "15AR", 0.92, 0.73, 0.97, 1.58},
    {"jis17ar", "17AR", 0.96, 0.76, 0.99, 1.58}, {"jis19ar", "19AR", 1.00, 0.80, 1.01, 1.58},
};

// From 44 on the numbers are men's, too; "eu50" has always been a man's here.
constexpr BuiltInSize kEuWomen[] = {
    {"eu34", "34", 0.80, 0.65, 0.90, 1.68},  {"eu36", "36", 0.84, 0.68, 0.94, 1.68},
    {"eu38", "38", 0.88, 0.72, 0.97, 1.68},  {"eu40", "40", 0.92, 0.76, 1.00, 1.68},
    {"eu42", "42", 0.96, 0.80, 1.03, 1.68},  {"eu44w", "44", 1.00, 0.84, 1.06, 1.68},
    {"eu46w", "46", 1.04, 0.88, 1.09, 1.68}, {"eu48w", "48", 1.10, 0.945, 1.14, 1.68},
    {"eu50w", "50", 1.16, 1.01, 1.19, 1.68}, {"eu52w", "52", 1.22, 1.075, 1.24, 1.68},
};
constexpr BuiltInSize kEuMen[] = {
    {"eu44m", "44", 0.88, 0.76, 0.90, 1.68}, {"eu46m", "46", 0.92, 0.80, 0.94, 1.71},
    {"eu48m", "48", 0.96, 0.84, 0.98, 1.75}, {"eu50", "50", 1.00, 0.88, 1.02, 1.78},
    {"eu52m", "52", 1.04, 0.92, 1.06, 1.80}, {"eu54m", "54", 1.08, 0.97, 1.10, 1.82},
    {"eu56m", "56", 1.12, 1.02, 1.14, 1.84}, {"eu58m", "58", 1.16, 1.07, 1.18, 1.86},
};

constexpr BuiltInSize kJisMen[] = {
    {"jis88a3", "88A3", 0.88, 0.76, 0.88, 1.60}, {"jis90a4", "90A4", 0.90, 0.78, 0.90, 1.65},
    {"jis92a5", "92A5", 0.92, 0.80, 0.92, 1.70}, {"jis94a6", "94A6", 0.94, 0.82, 0.94, 1.75},
    {"jis96a7", "96A7", 0.96, 0.84, 0.96, 1.80},
};

constexpr double inches(double count) { return count * 0.0254; }
constexpr double kMissesHeight = inches(65.5);
constexpr BuiltInSize kMisses[] = {
    {"misses6", "6", inches(30.5), inches(23), inches(32.5), kMissesHeight},
    {"misses8", "8", inches(31.5), inches(24), inches(33.5), kMissesHeight},
    {"misses10", "10", inches(32.5), inches(25), inches(34.5), kMissesHeight},
    {"misses12", "12", inches(34), inches(26.5), inches(36), kMissesHeight},
    {"misses14", "14", inches(36), inches(28), inches(38), kMissesHeight},
    {"misses16", "16", inches(38), inches(30), inches(40), kMissesHeight},
    {"misses18", "18", inches(40), inches(32), inches(42), kMissesHeight},
    {"misses20", "20", inches(42), inches(34), inches(44), kMissesHeight},
    {"misses22", "22", inches(44), inches(37), inches(46), kMissesHeight},
};

constexpr BuiltInSize kChildren[] = {
    {"child110", "110", 0.58, 0.54, 0.61, 1.10},   {"child116", "116", 0.60, 0.55, 0.635, 1.16},
    {"child122", "122", 0.625, 0.57, 0.665, 1.22}, {"child128", "128", 0.65, 0.59, 0.70, 1.28},
    {"child134", "134", 0.675, 0.605, 0.73, 1.34}, {"child140", "140", 0.70, 0.62, 0.76, 1.40},
    {"child146", "146", 0.73, 0.64, 0.79, 1.46},   {"child152", "152", 0.76, 0.66, 0.82, 1.52},
};

constexpr SizeSeries kSeries[] = {
    {SizeSystem::JisWomen, Sex::Female, "jis9ar", kJisWomen}, {SizeSystem::EuWomen, Sex::Female, "eu38", kEuWomen},
    {SizeSystem::EuMen, Sex::Male, "eu50", kEuMen},           {SizeSystem::JisMen, Sex::Male, "jis92a5", kJisMen},
    {SizeSystem::Misses, Sex::Female, "misses12", kMisses},   {SizeSystem::Children, Sex::Child, "child128", kChildren},
};

struct KnownSize {
  const BuiltInSize* size = nullptr;  // null: there is none
  Sex sex{};
};
// By its plain name. The letter that tells women's sizes of Europe from men's may stand on all of them: "eu38w".
KnownSize sizeCalled(std::string_view plain) {
  for (const SizeSeries& series : kSeries)
    for (const BuiltInSize& size : series.sizes) {
      const char* letter = series.system == SizeSystem::EuWomen ? "w" : series.system == SizeSystem::EuMen ? "m" : "";
      if (plain == size.name || plain == std::string(size.name) + letter) return {&size, series.sex};
    }
  return {};
}

}  // namespace

std::span<const SizeSeries> sizeSeries() { return kSeries; }

std::span<const std::string_view> builtInSizes() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const SizeSeries& series : kSeries)
      for (const BuiltInSize& size : series.sizes) all.push_back(size.name);
    return all;
  }();
  return names;
}

std::string plainSize(std::string_view name) {
  const KnownSize known = sizeCalled(plainName(name));
  return std::string(known.size ? known.size->name : name);
}

Result<Measurements> builtInSize(std::string_view name) {
  const std::string wanted = plainName(name.substr(0, 80));
  if (const auto [size, sex] = sizeCalled(wanted); size)
    return Measurements{
        sex,
        {{"bust_girth", size->bust}, {"waist_girth", size->waist}, {"hip_girth", size->hip}, {"height", size->height}}};
  const auto listed = [](std::string_view beginning) {
    std::string names;
    for (const std::string_view known : builtInSizes())
      if (known.starts_with(beginning)) names += (names.empty() ? "" : ", ") + std::string(known);
    return names;
  };
  std::string names = wanted.empty() ? "" : listed(wanted);  // "eu44": a woman's or a man's
  if (names.empty()) names = listed("");
  return notFound(say("There is no size called \"{0}\". Sizes: {1}.", name.substr(0, 80), names));
}

}  // namespace karinui
