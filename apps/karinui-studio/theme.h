#pragma once
// How the studio looks and in which language it speaks: one palette for light and one for dark, the icons, the words.
// GUI thread only.
#include <QColor>
#include <QIcon>
#include <QObject>
#include <QRectF>
#include <QString>
#include <QTranslator>
#include <functional>
#include <optional>
#include <string_view>

#include "karinui/base/said_lengths.h"
#include "karinui/design/glossary.h"
#include "karinui/scene/scene_frame.h"

class QAction;
class QApplication;
class QComboBox;

namespace karinui::studio {

struct Palette {
  QColor window, panel, raised, line, ink, faint, accent, accentSoft, paper, paperLine;
  QColor onAccent;  // letters on the accent
};

class Theme : public QObject {
  Q_OBJECT
 public:
  static Theme& here();

  Language language() const { return language_; }
  bool dark() const { return dark_; }
  void setLanguage(Language language);
  void setDark(bool dark);
  bool inches() const { return inches_; }  // instead of centimetres
  void setInches(bool inches);
  const Palette& palette() const;
  QString say(const Message& message) const;
  // What identifiers in sentences are called; without it as the glossary has them.
  void setNames(NameWords names) { names_ = std::move(names); }
  QIcon icon(std::string_view name) const;  // in today's colours
  void apply(QApplication& app);

  // Keeps the words (and the icon) of a thing right whatever language and colours come: `put` is called now and at each
  // change, as long as `owner` lives.
  void keep(QObject* owner, std::function<void()> put);
  void keep(QAction* action, const Message& label, const Message& hint, std::string_view icon = {});

 signals:
  void changed();

 private:
  Theme() = default;
  Language language_ = Language::English;
  // What Qt's own translation leaves in English.
  class Untranslated : public QTranslator {
   public:
    QString translate(const char* context, const char* source, const char*, int) const override;
    bool isEmpty() const override { return false; }
  };
  QTranslator ofQt_;
  Untranslated besideQt_;
  bool dark_ = false, inches_ = false;
  NameWords names_ = [](std::string_view identifier) { return identifierSaid(identifier); };
};

inline QString inWords(const Message& message) { return Theme::here().say(message); }
QString asLabel(const Message& message);  // with a capital letter
QString nameText(std::string_view name);  // of a piece, an edge, a line, a mark, a fabric
// The same where it stands alone: words of ours with a capital letter, a person's own as they wrote them.
QString nameLabel(std::string_view name);
// A box that may be narrower than its longest item says what is chosen in its tooltip.
void letShrink(QComboBox& box, const Message& hint = {});
QString scriptHint(const std::string& word);  // what scripts call it, for a tooltip
// Why Japanese cannot be shown on this machine; nothing: it can.
std::optional<Message> japaneseTrouble();
QString lengthText(double metres, int decimals = 1);  // "12.3 cm" or "4.84 in"
// As large as wished, and no larger than its screen, with room for a frame.
void resizeOnScreen(QWidget& window, QSize wish);
QString areaText(double squareMetres);  // "1234 cm²" or "191 in²"
QColor shown(const Colour& linear);     // linear light to screen
// Draws an icon of the house into a square.
void drawIcon(class QPainter& painter, std::string_view name, const class QRectF& square, const QColor& ink);

// Where a hand without a pointer is.
void paintFingertip(class QPainter& painter, const class QPointF& at);
void paintPin(class QPainter& painter, const class QPointF& tip);

// A hollow dot: what will move.
void paintRing(class QPainter& painter, const class QPointF& at, const class QColor& colour);

// Where a word's tag goes: above a place, wrapped and moved so that the whole of it lies within `bounds`.
QRectF wordTag(const class QFont& font, const QPointF& above, const QString& words, const QRectF& bounds);
// A word on a dark tag there.
void paintWord(class QPainter& painter, const QPointF& above, const QString& words, const QRectF& bounds);

}  // namespace karinui::studio
