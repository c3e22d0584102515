// What pieces are called in the languages and abbreviations of the trade.
#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "piece_names.h"

namespace karinui {

namespace {

struct Word {
  std::string_view word;
  PieceRole role;
  bool within = false;  // also as a part of a longer word
};

// The first that is found decides: what a piece is for comes before where it lies, "back waistband" being a waistband.
constexpr Word kWords[] = {
    // what hangs on nothing the garment needs
    {"pocket", PieceRole::Aside, true},
    {"tasche", PieceRole::Aside, true},
    {"poche", PieceRole::Aside, true},
    {"bolsillo", PieceRole::Aside, true},
    {"tasca", PieceRole::Aside, true},
    {"ポケット", PieceRole::Aside, true},
    {"карман", PieceRole::Aside, true},
    {"facing", PieceRole::Aside, true},
    {"beleg", PieceRole::Aside, true},
    {"parementure", PieceRole::Aside, true},
    {"見返し", PieceRole::Aside, true},
    {"lining", PieceRole::Aside, true},
    {"futter", PieceRole::Aside, true},
    {"doublure", PieceRole::Aside, true},
    {"裏地", PieceRole::Aside, true},
    {"interfac", PieceRole::Aside, true},
    {"fusing", PieceRole::Aside, true},
    {"placket", PieceRole::Aside, true},
    {"overlap", PieceRole::Aside, true},
    {"underlap", PieceRole::Aside, true},
    {"belt", PieceRole::Aside},
    {"loop", PieceRole::Aside, true},
    {"flap", PieceRole::Aside, true},
    {"fly", PieceRole::Aside},
    {"tab", PieceRole::Aside},
    {"hood", PieceRole::Aside, true},
    {"binding", PieceRole::Aside, true},
    {"welt", PieceRole::Aside, true},
    {"gusset", PieceRole::Aside, true},
    // bands
    {"collarstand", PieceRole::CollarStand, true},
    {"stand", PieceRole::CollarStand},
    {"steg", PieceRole::CollarStand},
    {"kragensteg", PieceRole::CollarStand, true},
    {"台衿", PieceRole::CollarStand, true},
    {"waistband", PieceRole::Waistband, true},
    {"wb", PieceRole::Waistband},
    {"bund", PieceRole::Waistband},
    {"hosenbund", PieceRole::Waistband, true},
    {"ceinture", PieceRole::Waistband, true},
    {"pretina", PieceRole::Waistband, true},
    {"cinturilla", PieceRole::Waistband, true},
    {"cinturino", PieceRole::Waistband, true},
    {"tailleband", PieceRole::Waistband, true},
    {"пояс", PieceRole::Waistband, true},
    {"ウエスト", PieceRole::Waistband, true},
    {"cuff", PieceRole::Cuff, true},
    {"manschette", PieceRole::Cuff, true},
    {"poignet", PieceRole::Cuff, true},
    {"puño", PieceRole::Cuff, true},
    {"polsino", PieceRole::Cuff, true},
    {"manchet", PieceRole::Cuff, true},
    {"манжет", PieceRole::Cuff, true},
    {"カフス", PieceRole::Cuff, true},
    {"collar", PieceRole::Collar, true},
    {"neckband", PieceRole::Collar, true},
    {"rib", PieceRole::Collar},
    {"co", PieceRole::Collar},
    {"col", PieceRole::Collar},
    {"clr", PieceRole::Collar},
    {"kragen", PieceRole::Collar, true},
    {"cuello", PieceRole::Collar, true},
    {"colletto", PieceRole::Collar, true},
    {"collo", PieceRole::Collar},
    {"kraag", PieceRole::Collar, true},
    {"krage", PieceRole::Collar, true},
    {"воротник", PieceRole::Collar, true},
    {"衿", PieceRole::Collar, true},
    {"襟", PieceRole::Collar, true},
    {"yoke", PieceRole::Yoke, true},
    {"passe", PieceRole::Yoke},
    {"sattel", PieceRole::Yoke, true},
    {"empiècement", PieceRole::Yoke, true},
    {"canesu", PieceRole::Yoke, true},
    {"canesú", PieceRole::Yoke, true},
    {"sprone", PieceRole::Yoke, true},
    {"кокетк", PieceRole::Yoke, true},
    {"ヨーク", PieceRole::Yoke, true},
    {"sleeve", PieceRole::Sleeve, true},
    {"slv", PieceRole::Sleeve},
    {"sl", PieceRole::Sleeve},
    {"ärmel", PieceRole::Sleeve, true},
    {"aermel", PieceRole::Sleeve, true},
    {"armel", PieceRole::Sleeve, true},
    {"manche", PieceRole::Sleeve, true},
    {"manga", PieceRole::Sleeve, true},
    {"manica", PieceRole::Sleeve, true},
    {"mouw", PieceRole::Sleeve, true},
    {"rękaw", PieceRole::Sleeve, true},
    {"рукав", PieceRole::Sleeve, true},
    {"袖", PieceRole::Sleeve, true},
    // where it lies
    {"front", PieceRole::Front, true},
    {"fr", PieceRole::Front},
    {"frt", PieceRole::Front},
    {"frnt", PieceRole::Front},
    {"vorder", PieceRole::Front, true},
    {"vorne", PieceRole::Front},
    {"vt", PieceRole::Front},
    {"devant", PieceRole::Front, true},
    {"delantero", PieceRole::Front, true},
    {"davanti", PieceRole::Front, true},
    {"frente", PieceRole::Front, true},
    {"voorpand", PieceRole::Front, true},
    {"przód", PieceRole::Front, true},
    {"перед", PieceRole::Front, true},
    {"полочк", PieceRole::Front, true},
    {"前", PieceRole::Front, true},
    {"back", PieceRole::Back, true},
    {"bk", PieceRole::Back},
    {"bck", PieceRole::Back},
    {"rücken", PieceRole::Back, true},
    {"ruecken", PieceRole::Back, true},
    {"hinter", PieceRole::Back, true},
    {"ht", PieceRole::Back},
    {"dos", PieceRole::Back},
    {"espalda", PieceRole::Back, true},
    {"trasero", PieceRole::Back, true},
    {"dietro", PieceRole::Back, true},
    {"costas", PieceRole::Back, true},
    {"rugpand", PieceRole::Back, true},
    {"achterpand", PieceRole::Back, true},
    {"tył", PieceRole::Back, true},
    {"спинк", PieceRole::Back, true},
    {"後", PieceRole::Back, true},
    // a whole leg
    {"leg", PieceRole::Leg},
    {"legging", PieceRole::Leg, true},
    {"ll", PieceRole::Leg},
};

// Lower case of the letters that European names need; others stay.
std::string lowered(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 0x80) {
      out += static_cast<char>(std::tolower(c));
    } else if (c == 0xC3 && i + 1 < text.size()) {  // Latin-1: capitals lie 32 before small letters
      const auto next = static_cast<unsigned char>(text[++i]);
      out += '\xC3';
      out += static_cast<char>(next >= 0x80 && next <= 0x9E && next != 0x97 ? next + 0x20 : next);
    } else if (c == 0xD0 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) >= 0x90 &&
               static_cast<unsigned char>(text[i + 1]) <= 0xAF) {  // Cyrillic А to Я
      const auto next = static_cast<unsigned char>(text[++i]);
      out += next < 0xA0 ? '\xD0' : '\xD1';
      out += static_cast<char>(next < 0xA0 ? next + 0x20 : next - 0x20);
    } else {
      out += static_cast<char>(c);
    }
  }
  return out;
}

}  // namespace

std::vector<std::string> wordsOf(std::string_view name) {
  std::vector<std::string> words;
  std::string word;
  const auto end = [&] {
    if (!word.empty()) words.push_back(lowered(word));
    word.clear();
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    const bool letter = c >= 0x80 || std::isalpha(c);
    // frontLeft is two words, and so are SL and 1.
    if (letter && std::isupper(c) && !word.empty() && std::islower(static_cast<unsigned char>(word.back()))) end();
    if (letter)
      word += name[i];
    else
      end();
  }
  end();
  return words;
}

PieceRole roleNamed(std::string_view name) {
  const std::vector<std::string> words = wordsOf(name);
  const std::string all = lowered(name);
  for (const Word& one : kWords) {
    if (one.within ? all.find(one.word) != std::string::npos
                   : std::find(words.begin(), words.end(), one.word) != words.end())
      return one.role;
  }
  // "collar stand" and "collarStand"
  return PieceRole::Unknown;
}

std::optional<PieceReading::Side> sideNamed(std::string_view name) {
  const auto has = [words = wordsOf(name)](std::initializer_list<std::string_view> any) {
    return std::any_of(any.begin(), any.end(),
                       [&](std::string_view one) { return std::find(words.begin(), words.end(), one) != words.end(); });
  };
  const bool left = has({"left", "l", "lt", "lh", "links", "linke", "gauche", "izquierda", "izquierdo", "sinistra",
                         "sinistro", "левая", "левый", "左"});
  const bool right = has({"right", "r", "rt", "rh", "rechts", "rechte", "droite", "droit", "derecha", "derecho",
                          "destra", "destro", "правая", "правый", "右"});
  if (left == right) return std::nullopt;
  return left ? PieceReading::Side::Left : PieceReading::Side::Right;
}

}  // namespace karinui
