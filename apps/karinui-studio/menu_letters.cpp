#include "menu_letters.h"

#include <QMenu>
#include <map>
#include <set>
#include <vector>

namespace karinui::studio {

namespace {

// Of an action: its words, and what they were made into.
constexpr const char *kWordsAlone = "words", *kLettered = "lettered";

bool isLatin(QChar c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

bool allLatin(const QString& words) {
  for (const QChar c : words)
    if (c.isLetter() && !isLatin(c)) return false;
  return true;
}

// The letters of the words, those that begin one first: where each stands.
std::vector<int> lettersIn(const QString& words) {
  std::vector<int> all;
  std::set<QChar> known;
  for (const bool firstOfWord : {true, false})
    for (int k = 0; k < words.size(); ++k)
      if (isLatin(words[k]) && (!firstOfWord || k == 0 || !words[k - 1].isLetterOrNumber()) &&
          known.insert(words[k].toUpper()).second)
        all.push_back(k);
  return all;
}

// Gives each of the words a letter of its own as far as there are enough: one that has all of its letters taken gets
// the letter of another, if that can have a different one.
class Letters {
 public:
  explicit Letters(std::vector<QString> words) : words_(std::move(words)), at_(words_.size(), -1) {
    for (const QString& one : words_) in_.push_back(lettersIn(one));
    for (std::size_t k = 0; k < words_.size(); ++k) {
      std::set<QChar> asked;
      if (!place(k, asked) && !in_[k].empty()) at_[k] = in_[k].front();  // shared
    }
  }
  int at(std::size_t k) const { return at_[k]; }  // where it stands; -1: the words have none

 private:
  bool place(std::size_t k, std::set<QChar>& asked) {
    for (const bool free : {true, false})
      for (const int at : in_[k]) {
        const QChar letter = words_[k][at].toUpper();
        const auto owner = owners_.find(letter);
        if (free ? owner != owners_.end() : !asked.insert(letter).second || !place(owner->second, asked)) continue;
        owners_[letter] = k, at_[k] = at;
        return true;
      }
    return false;
  }
  std::vector<QString> words_;
  std::vector<std::vector<int>> in_;
  std::vector<int> at_;
  std::map<QChar, std::size_t> owners_;
};

QString escaped(QString words) { return words.replace("&", "&&"); }

}  // namespace

QString withoutLetter(const QAction& one) {
  const QVariant lettered = one.property(kLettered);
  return lettered.isValid() && lettered.toString() == one.text() ? one.property(kWordsAlone).toString() : one.text();
}

void giveLetters(QMenu& menu) {
  std::vector<QAction*> entries;
  std::vector<QString> english;
  for (QAction* one : menu.actions()) {
    if (one->isSeparator()) continue;
    if (one->menu()) giveLetters(*one->menu());
    const QString words = withoutLetter(*one);
    entries.push_back(one);
    english.push_back(!one->isVisible() ? QString() : allLatin(words) ? words : one->property(kEnglish).toString());
  }
  const Letters letters(english);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    QAction* one = entries[k];
    const QString words = withoutLetter(*one);
    QString lettered = escaped(words);
    if (const int at = letters.at(k); at >= 0 && allLatin(words)) {
      lettered = escaped(words.left(at)) + "&" + escaped(words.mid(at));
    } else if (at >= 0) {
      const bool goesOn = words.endsWith(QChar(0x2026));
      lettered = escaped(goesOn ? words.chopped(1) : words) + "(&" + english[k][at].toUpper() + ")" +
                 (goesOn ? words.right(1) : "");
    }
    one->setProperty(kWordsAlone, words);
    one->setProperty(kLettered, lettered);
    if (one->text() != lettered) one->setText(lettered);
  }
}

void keepLetters(QMenu& menu) {
  QObject::connect(&menu, &QMenu::aboutToShow, &menu, [&menu] { giveLetters(menu); });
}

}  // namespace karinui::studio
