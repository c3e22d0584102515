#include "step_field.h"

#include <QComboBox>
#include <QLineEdit>
#include <QPainter>
#include <QRegularExpression>
#include <QStyleOptionFrame>
#include <numbers>

#include "karinui/base/number.h"
#include "karinui/body/sizes.h"
#include "karinui/design/formula.h"
#include "length_box.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// Words for a script's text, and the way back.
struct Wording {
  std::function<QString(const std::string&)> words;
  std::function<std::string(const QString&)> script;  // null: typed as scripts write it
};

std::string utf8(const QString& text) { return text.trimmed().toStdString(); }

// With digits and signs of full width, as Japanese input gives them, in their usual form.
QString inUsualWidth(const QString& text) { return text.normalized(QString::NormalizationForm_KC); }

// "5 cm", "0 cm", "2.5 cm": no more digits than there are.
QString shortLength(double metres) {
  QString words = lengthText(metres, 3);
  return words.replace(QRegularExpression("\\.?0+(?= )"), QString());
}

// Lengths with commas and semicolons between; bare numbers where the field counts no length (gravity).
Wording lengthsWording(bool bare) {
  const auto one = [bare](const std::string& script) {
    const auto metres = parseLength(script);
    if (!metres) return QString::fromStdString(script);
    return bare ? QString::fromStdString(shortest(*metres)) : shortLength(*metres);
  };
  const auto each = [](const QString& text, const QString& between, const auto& what) {
    QStringList items;
    for (const QString& item : text.split(';', Qt::SkipEmptyParts)) {
      QStringList numbers;
      for (const QString& number : item.split(',')) numbers << what(number.trimmed());
      items << numbers.join(between);
    }
    return items.join("; ");
  };
  return {[=](const std::string& script) {
            return each(QString::fromStdString(script), ", ", [&](const QString& n) { return one(n.toStdString()); }) +
                   (bare ? " m/s²" : "");
          },
          [=](const QString& typed) {
            QString text = inUsualWidth(typed);
            if (bare) text.remove(inUsualWidth("m/s²"));
            return each(text, ",",
                        [&](const QString& n) {
                          if (bare) return n;
                          const auto metres = metresIn(n);
                          return metres ? QString::fromStdString(shortest(*metres)) + "m" : n;
                        })
                .toStdString();
          }};
}

// A list of things with names: those that are there, and those it held before.
Wording namesWording(const Document& document, std::string_view operation, const FieldHelp& field,
                     const std::string& held) {
  const bool edges = field.kind.ends_with("piece.edge"), seams = field.kind.ends_with("seam");
  const std::string kind = field.kind;
  const auto split = [](const std::string& script) {
    return QString::fromStdString(script).split(QRegularExpression("[;\\s]+"), Qt::SkipEmptyParts);
  };
  std::vector<std::pair<QString, std::string>> known;
  const auto said = [&](const std::string& script) { return inWords(valueSaid(document, operation, field, script)); };
  for (const QString& item : split(held)) known.push_back({said(item.toStdString()), item.toStdString()});
  for (const auto& [id, piece] : document.pattern.pieces) {
    if (!edges && !seams) known.push_back({said(text(id)), text(id)});
    for (const Edge& edge : piece->outline.edges)
      if (const std::string script = text(id) + "." + edge.name; edges) known.push_back({said(script), script});
  }
  for (const auto& [id, seam] : document.pattern.seams)
    if (seams) known.push_back({said(text(id)), text(id)});
  const auto wordsOf = [known](const QString& script) {
    for (const auto& [words, own] : known)
      if (own == script.toStdString()) return words;
    return script;
  };
  return {[=](const std::string& script) {
            QStringList items;
            for (const QString& item : split(script)) items << wordsOf(item);
            return items.join("; ");
          },
          [=](const QString& typed) {
            QStringList items;
            for (const QString& item : typed.split(';', Qt::SkipEmptyParts)) {
              const QString name = item.trimmed();
              QString script = edges ? name : QString::fromStdString(nameTyped(utf8(name)));
              for (const auto& [words, own] : known)
                if (words.compare(name, Qt::CaseInsensitive) == 0) script = QString::fromStdString(own);
              items << script;
            }
            return items.join("; ").toStdString();
          }};
}

// "Bust girth 88 cm; Waist girth 64 cm"
Wording measuresWording() {
  return {[](const std::string& script) {
            QStringList items;
            for (const QString& item : QString::fromStdString(script).split(';', Qt::SkipEmptyParts)) {
              const std::string key = utf8(item.section('=', 0, 0));
              const auto metres = parseLength(utf8(item.section('=', 1)));
              const QString name = inWords(identifierSaid(key).value_or(say("{0}", key)));
              items << name + " " + (metres && !isAngle(key) ? shortLength(*metres) : item.section('=', 1).trimmed());
            }
            return items.join("; ");
          },
          [](const QString& typed) {
            static const QRegularExpression measure("^(.*?)[\\s=:：]*([-+]?[\\d.]+(?:[\\s-]+\\d+/\\d+)?\\s*[a-z\"]*)$");
            QStringList items;
            for (const QString& item : inUsualWidth(typed).split(';', Qt::SkipEmptyParts)) {
              const auto match = measure.match(item.trimmed());
              const std::string name = utf8(match.captured(1));
              const auto key = measurementKey(identifierOf(name).value_or(name));
              const auto metres = metresIn(match.captured(2));
              if (!match.hasMatch() || !key)
                items << item.trimmed();
              else
                items << QString::fromStdString(*key + "=") + (metres && !isAngle(*key)
                                                                   ? QString::fromStdString(shortest(*metres)) + "m"
                                                                   : match.captured(2).remove(' '));
            }
            return items.join("; ").toStdString();
          }};
}

// A number with what it counts; the factor leads from the script's number to the one that is read.
Wording numberWording(const Document& document, std::string_view operation, const FieldHelp& field) {
  const double factor = field.name == "at" || field.name == "to_at" || field.name.starts_with("toe") ? 100
                        : field.name == "weight"                                                     ? 1000
                        : field.name.starts_with("bend")                                             ? 1e6
                                                                                                     : 1;
  return {[&document, operation = std::string(operation), field](const std::string& script) {
            return inWords(valueSaid(document, operation, field, script));
          },
          [factor](const QString& typed) {
            static const QRegularExpression number("^\\s*([-+]?[\\d.]+(?:e[-+]?\\d+)?)\\s*(.*)$");
            if (const auto formula = Formula::parse(utf8(typed)); formula && formula->terms().size() > 1)
              return utf8(typed);
            const auto match = number.match(inUsualWidth(typed));
            const auto value = parseNumber(match.captured(1).toStdString());
            if (!value) return utf8(typed);
            // A bare number below one is a share, as scripts write it.
            const bool share = factor == 100 && match.captured(2).isEmpty() && *value <= 1;
            return shortest(share ? *value : *value / factor);
          }};
}

Wording angleWording() {
  return {[](const std::string& script) {
            const auto radians = parseAngle(script);
            return radians ? QString::fromStdString(shortest(std::round(*radians * 1800 / std::numbers::pi) / 10)) + "°"
                           : QString::fromStdString(script);
          },
          [](const QString& typed) {
            const QString bare = QString(typed).remove("°").trimmed();
            const bool number = parseNumber(bare.toStdString()).has_value();
            return (number ? bare + "deg" : bare).toStdString();
          }};
}

Wording wordingOf(const Document& document, std::string_view operation, const FieldHelp& field,
                  const std::string& held) {
  const std::string kind = field.kind.starts_with("list of ") ? field.kind.substr(8) : field.kind;
  if (kind == "length" || kind == "u,v" || kind == "x,y,z") return lengthsWording(field.name == "gravity");
  if (kind == "piece" || kind == "seam" || kind == "piece.edge") return namesWording(document, operation, field, held);
  if (kind == "measurement=length") return measuresWording();
  if (kind == "number") return numberWording(document, operation, field);
  if (kind == "angle") return angleWording();
  const auto words = [&document, operation = std::string(operation), field](const std::string& script) {
    return inWords(valueSaid(document, operation, field, script));
  };
  if (kind == "name" && kind == field.kind && field.name != "mesh")
    return {words, [](const QString& typed) { return nameTyped(utf8(typed)); }};
  return {words, nullptr};
}

class WordsEdit : public QLineEdit {
 public:
  WordsEdit(std::string held, Wording wording) : held_(std::move(held)), wording_(std::move(wording)) {
    if (!held_.empty()) words_ = wording_.words(held_);
    setText(words_);
    setCursorPosition(0);
  }
  std::string value() const {
    const QString typed = text().trimmed();
    if (typed == words_.trimmed()) return held_;
    return wording_.script && !typed.isEmpty() ? wording_.script(typed) : typed.toStdString();
  }

 protected:
  void focusInEvent(QFocusEvent* event) override {
    if (!wording_.script && text() == words_) setText(QString::fromStdString(held_));
    QLineEdit::focusInEvent(event);
  }
  // What is longer than the field ends in “…” until it is typed in.
  void paintEvent(QPaintEvent* event) override {
    QStyleOptionFrame option;
    initStyleOption(&option);
    const QRect room = style()->subElementRect(QStyle::SE_LineEditContents, &option, this).adjusted(2, 0, -2, 0);
    if (hasFocus() || fontMetrics().horizontalAdvance(text()) <= room.width()) return QLineEdit::paintEvent(event);
    QPainter painter(this);
    style()->drawPrimitive(QStyle::PE_PanelLineEdit, &option, &painter, this);
    style()->drawItemText(&painter, room, Qt::AlignLeft | Qt::AlignVCenter, palette(), isEnabled(),
                          fontMetrics().elidedText(text(), Qt::ElideRight, room.width()), QPalette::Text);
  }
  void focusOutEvent(QFocusEvent* event) override {
    QLineEdit::focusOutEvent(event);
    if (!wording_.script && text().toStdString() == held_) setText(words_);
    setCursorPosition(0);
  }

 private:
  std::string held_;
  Wording wording_;
  QString words_;
};

// The few values a field may have, each by its name; nothing chosen: as it is without being written.
QComboBox* choices(const Document& document, std::string_view operation, const FieldHelp& field,
                   const std::string& value) {
  auto* box = new QComboBox;
  const auto add = [&](const QString& script) {
    box->addItem(inWords(valueSaid(document, operation, field, script.toStdString())), script);
  };
  const std::string now = value.empty() ? field.usual : value;
  // Pieces that are drafted or drawn are of a fabric also where none is said.
  const bool drawn = operation == DraftBlock::kName || operation == DrawRectangle::kName ||
                     operation == DrawPolygon::kName || operation == DrawRing::kName;
  if (field.usual.empty() && !field.needed)
    box->addItem(field.name == "fabric" && drawn
                     ? inWords(say("as usual: {0}", valueSaid(document, operation, field, Piece().fabric)))
                     : "–",
                 QString());
  if (field.kind.find('|') != std::string::npos) {
    for (const QString& script : QString::fromStdString(field.kind).split('|')) add(script);
  } else if (field.name == "size") {
    for (const std::string_view size : builtInSizes())
      add(QString::fromUtf8(size.data(), static_cast<qsizetype>(size.size())));
  } else {
    for (const Fabric& fabric : presets()) add(QString::fromStdString(fabric.name));
    for (const auto& [name, fabric] : document.fabrics)
      if (box->findData(QString::fromStdString(name)) < 0) add(QString::fromStdString(name));
  }
  if (box->findData(QString::fromStdString(now)) < 0) add(QString::fromStdString(now));
  box->setCurrentIndex(box->findData(QString::fromStdString(now)));
  return box;
}

}  // namespace

StepField stepField(const Document& document, std::string_view operation, const FieldHelp& field,
                    const std::string& value, std::function<void()> entered) {
  StepField made;
  made.name = field.name;
  const bool fabric = field.name == "fabric" || field.name == "like";
  if (field.kind.find('|') != std::string::npos || field.name == "size" || fabric) {
    QComboBox* box = choices(document, operation, field, value);
    made.box = box;
    made.value = [box, value, usual = field.usual] {
      const std::string chosen = box->currentData().toString().toStdString();
      return value.empty() && chosen == usual ? std::string() : chosen;
    };
  } else {
    const Wording wording = wordingOf(document, operation, field, value);
    auto* box = new WordsEdit(value, wording);
    if (!field.usual.empty()) box->setPlaceholderText(wording.words(field.usual));
    QObject::connect(box, &QLineEdit::returnPressed, box, std::move(entered));
    made.box = box;
    made.value = [box] { return box->value(); };
  }
  made.box->setObjectName(QString::fromStdString(field.name));
  made.box->setAccessibleName(inWords(fieldSaid(operation, field.name)));
  const QString name = inWords(fieldSaid(operation, field.name)).toHtmlEscaped(),
                help = "<br>" + scriptHint(field.name).toHtmlEscaped() + ", " +
                       inWords(Message{field.help, {}}).toHtmlEscaped();
  if (auto* line = qobject_cast<QLineEdit*>(made.box)) {
    const auto tell = [line, name, help] {
      const QString held = line->text().left(600).toHtmlEscaped();
      line->setToolTip(name + (held.isEmpty() ? QString() : ": " + held) + help);
    };
    tell();
    QObject::connect(line, &QLineEdit::textChanged, line, tell);
  }
  if (auto* box = qobject_cast<QComboBox*>(made.box)) {
    letShrink(*box);
    box->setToolTip(name + help + "<br>" + box->currentText().toHtmlEscaped());
  }
  return made;
}

}  // namespace karinui::studio
