#include "menu_letters.h"

#include <QMenu>
#include <set>

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

// Where a letter stands in the words that is not taken: the first of a word, or else any. Where all are, the first one
// goes from one entry that has it to the next.
int freeLetter(const QString& words, const std::set<QChar>& taken) {
  for (const bool firstOfWord : {true, false})
    for (int k = 0; k < words.size(); ++k)
      if (isLatin(words[k]) && !taken.contains(words[k].toUpper()) &&
          (!firstOfWord || k == 0 || !words[k - 1].isLetterOrNumber()))
        return k;
  for (int k = 0; k < words.size(); ++k)
    if (isLatin(words[k])) return k;
  return -1;
}

QString escaped(QString words) { return words.replace("&", "&&"); }

}  // namespace

QString withoutLetter(const QAction& one) {
  const QVariant lettered = one.property(kLettered);
  return lettered.isValid() && lettered.toString() == one.text() ? one.property(kWordsAlone).toString() : one.text();
}

void giveLetters(QMenu& menu) {
  std::set<QChar> taken;
  for (QAction* one : menu.actions()) {
    if (one->isSeparator()) continue;
    if (one->menu()) giveLetters(*one->menu());
    const QString words = withoutLetter(*one);
    QString lettered = escaped(words);
    if (one->isVisible() && !words.isEmpty()) {
      const bool own = allLatin(words);
      const QString english = own ? words : one->property(kEnglish).toString();
      if (const int at = freeLetter(english, taken); at >= 0) {
        const QChar letter = english[at].toUpper();
        taken.insert(letter);
        if (own) {
          lettered = escaped(words.left(at)) + "&" + escaped(words.mid(at));
        } else {
          const bool goesOn = words.endsWith(QChar(0x2026));
          lettered = escaped(goesOn ? words.chopped(1) : words) + "(&" + letter + ")" + (goesOn ? words.right(1) : "");
        }
      }
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
