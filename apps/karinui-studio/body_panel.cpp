#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>

#include "karinui/base/number.h"
#include "length_box.h"
#include "look.h"
#include "panels.h"

namespace karinui::studio {

namespace {

struct Asked {
  const char* key;
  Message label;
};
const std::vector<Asked>& asked() {
  static const std::vector<Asked> all{{"height", say("height")},
                                      {"bust_girth", say("bust girth")},
                                      {"under_bust_girth", say("under-bust girth")},
                                      {"waist_girth", say("waist girth")},
                                      {"hip_girth", say("hip girth")},
                                      {"shoulder_width", say("shoulder width")},
                                      {"arm_length", say("arm length")},
                                      {"inside_leg", say("inside leg")}};
  return all;
}

}  // namespace

BodyPanel::BodyPanel(Session& session) : Panel(session) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 14, 14, 14);
  column->setSpacing(10);
  auto* form = new QFormLayout;
  form->addRow(title(say("Figure")));
  size_ = new QComboBox;
  Look::here().keep(size_, [this] {
    const int was = size_->currentIndex();
    size_->clear();
    size_->addItem(inWords(say("by measurements only")));
    for (const std::string_view s : builtInSizes())
      size_->addItem(QString::fromUtf8(s.data(), static_cast<int>(s.size())).toUpper());
    size_->setCurrentIndex(std::max(0, was));
  });
  size_->setCurrentIndex(1);
  sex_ = new QComboBox;
  Look::here().keep(sex_, [this] {
    const int was = sex_->currentIndex();
    sex_->clear();
    sex_->addItem(inWords(say("as the size")));
    sex_->addItem(inWords(say("female")));
    sex_->addItem(inWords(say("male")));
    sex_->setCurrentIndex(std::max(0, was));
  });
  form->addRow(word(say("Size")), size_);
  form->addRow(word(say("Shape")), sex_);
  const auto keys = mannequinKeys();
  for (const Asked& a : asked()) {
    if (std::find(keys.begin(), keys.end(), std::string_view(a.key)) == keys.end()) continue;
    auto* box = new LengthBox(a.label, 0, 2.6);
    box->setSpecialValueText("–");
    box->setMetres(0);
    form->addRow(word(a.label), box);
    typed_[a.key] = box;
  }
  column->addLayout(form);
  use_ = new QPushButton;
  Look::here().keep(use_, [this] {
    use_->setText(inWords(say("Put the garment on this figure")));
    use_->setToolTip(inWords(say("The same paper on another figure: it settles anew.")));
  });
  replay_ = new QPushButton;
  Look::here().keep(replay_, [this] {
    replay_->setText(inWords(say("Make the garment anew for it…")));
    replay_->setToolTip(
        inWords(say("Plays every step again on the new figure, into a document of its own: made to measure.")));
  });
  auto* load = new QPushButton;
  Look::here().keep(load, [load] { load->setText(inWords(say("Import a body…"))); });
  column->addWidget(use_);
  column->addWidget(replay_);
  column->addWidget(load);
  column->addWidget(title(say("As measured")));
  measured_ = new QLabel;
  measured_->setProperty("role", "faint");
  measured_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* scroll = new QScrollArea;
  scroll->setWidget(measured_);
  scroll->setWidgetResizable(true);
  column->addWidget(scroll, 1);
  connect(use_, &QPushButton::clicked, this, [this] { session_.perform(wished()); });
  connect(replay_, &QPushButton::clicked, this, [this] { emit replayAsked(wished()); });
  connect(load, &QPushButton::clicked, this, &BodyPanel::importAsked);
}

SetBody BodyPanel::wished() const {
  SetBody body;
  if (size_->currentIndex() > 0)
    body.size = std::string(builtInSizes()[static_cast<std::size_t>(size_->currentIndex() - 1)]);
  if (sex_->currentIndex() > 0) body.sex = sex_->currentIndex() == 1 ? Sex::Female : Sex::Male;
  for (const auto& [key, box] : typed_)
    if (box->value() > 0) body.set.push_back({key, {box->value()}});
  return body;
}

void BodyPanel::refresh() {
  replay_->setEnabled(!session_.fitting().document.pattern.pieces.empty());
  const Fitting& fitting = session_.fitting();
  const std::string now = fitting.body ? fitting.body->hash() : "-";
  if (now == shown_) return;
  shown_ = now;
  QString lines;
  if (fitting.body)
    for (const auto& [key, value] : fitting.body->measured().value)
      lines +=
          "<tr><td>" + QString::fromStdString(key).replace('_', ' ') + "&nbsp;&nbsp;</td><td align=right>" +
          QString::fromStdString(isAngle(key) ? fixed(value * 57.29577951, 1) + "°" : lengthText(value).toStdString()) +
          "</td></tr>";
  measured_->setText("<table>" + lines + "</table>");
}

}  // namespace karinui::studio
