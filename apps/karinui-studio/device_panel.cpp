#include "device_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>
#include <algorithm>
#include <cmath>

#include "file_filter.h"
#include "karinui/base/number.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr int kFineness = 100;  // of the bar: steps a newton

// What the other hand may hold.
constexpr std::array kOthers{DeviceKind::None, DeviceKind::Inverse3, DeviceKind::Touch};

// A box whose items are said in the language of the moment.
QComboBox* choices(const std::vector<Message>& items) {
  auto* box = new QComboBox;
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  Theme::here().keep(box, [box, items] {
    const int was = box->currentIndex();
    const QSignalBlocker quiet(box);
    box->clear();
    for (const Message& item : items) box->addItem(inWords(item));
    box->setCurrentIndex(std::max(0, was));
  });
  return box;
}

QPushButton* button(const Message& words, const Message& hint) {
  auto* made = new QPushButton;
  Theme::here().keep(made, [made, words, hint] {
    made->setText(inWords(words));
    made->setToolTip(inWords(hint));
  });
  return made;
}

QDoubleSpinBox* number(double low, double high, double step, int decimals) {
  auto* box = new QDoubleSpinBox;
  box->setRange(low, high);
  box->setSingleStep(step);
  box->setDecimals(decimals);
  box->setKeyboardTracking(false);
  return box;
}

}  // namespace

DevicePanel::DevicePanel(Session& session, ForceFeedback& force, QWidget* in) : Panel(session, in), force_(force) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 14, 14, 14);
  column->setSpacing(10);
  auto* form = new QFormLayout;
  form->addRow(title(say("Force feedback")));
  kind_ = choices(deviceNames());
  kind_->setObjectName("device");
  form->addRow(word(say("device")), kind_);
  std::vector<Message> others;
  for (const DeviceKind kind : kOthers) others.push_back(deviceNames()[static_cast<std::size_t>(kind)]);
  other_ = choices(others);
  other_->setObjectName("other_device");
  Theme::here().keep(other_, [this] {
    other_->setToolTip(inWords(say("Turns the body while its button is down; it has no force.")));
  });
  form->addRow(word(say("other hand")), other_);
  column->addLayout(form);
  look_ =
      button(say("Look for devices"), say("Asks the makers' services on this computer; nothing is sent elsewhere."));
  column->addWidget(look_);
  found_ = new QLabel;
  found_->setWordWrap(true);
  found_->hide();
  column->addWidget(found_);
  state_ = new QLabel;
  state_->setObjectName("device_state");
  state_->setWordWrap(true);
  column->addWidget(state_);
  newtons_ = new QProgressBar;
  newtons_->setObjectName("newtons");
  newtons_->setTextVisible(false);  // the bar is thinner than words
  Theme::here().keep(newtons_, [this] { newtons_->setAccessibleName(inWords(say("force"))); });
  column->addWidget(newtons_);
  newtonsSaid_ = new QLabel;
  newtonsSaid_->setObjectName("newtons_said");
  column->addWidget(newtonsSaid_);
  off_ = button(say("Emergency off (F9 or Pause)"),
                say("Ends the force at once; again, and it comes back softly where nothing is touched."));
  off_->setObjectName("emergency_off");
  off_->setCheckable(true);
  off_->setStyleSheet(
      "QPushButton { background: #b3261e; color: white; font-weight: bold; } "
      "QPushButton:checked { background: #5b1410; }");
  column->addWidget(off_);
  test_ = button(say("Test feel"), say("For four seconds a level floor lies 1 cm below the tip; a click ends it."));
  test_->setObjectName("test_feel");
  column->addWidget(test_);
  record_ = new QPushButton;
  record_->setObjectName("record_hand");
  record_->setCheckable(true);
  Theme::here().keep(record_, [this] {
    record_->setToolTip(inWords(
        say("Writes what the hand does and feels into a file, a thousand times a second: for “karinui touch replay” "
            "and for your own plots. Save a copy of the garment first; a hand is replayed on it.")));
  });
  column->addWidget(record_);

  form = new QFormLayout;
  form->addRow(title(say("Force")));
  gain_ = new QSlider(Qt::Horizontal);
  gain_->setObjectName("gain");
  gain_->setRange(0, 100);
  gainSaid_ = new QLabel;
  Theme::here().keep(gain_, [this] { gain_->setAccessibleName(inWords(say("gain"))); });
  form->addRow(word(say("gain")), gain_);
  form->addRow(QString(), gainSaid_);
  limit_ = number(0, 10, 0.5, 1);
  limit_->setObjectName("limit");
  limit_->setSuffix(" N");
  form->addRow(word(say("limit")), limit_);
  pull_ = choices({say("not felt"), say("springs, the historical law"), say("the fabric's own curve"),
                   say("the solver's stiffness")});
  form->addRow(word(say("pulled cloth")), pull_);
  for (const auto& [words, law] : {std::pair(say("contact"), &TouchLaws::contact),
                                   {say("friction"), &TouchLaws::friction},
                                   {say("weight of what is carried"), &TouchLaws::weight},
                                   {say("resistance of a cut"), &TouchLaws::cutting},
                                   {say("click of a snap"), &TouchLaws::click},
                                   {say("threads of the weave"), &TouchLaws::weave}}) {
    auto* box = new QCheckBox;
    Theme::here().keep(box, [box, words = words] { box->setText(asLabel(words)); });
    connect(box, &QCheckBox::toggled, this,
            [this, law = law](bool on) { set([&](DeviceSettings& now) { now.laws.*law = on; }); });
    laws_.emplace_back(box, law);
    form->addRow(box);
  }
  column->addLayout(form);

  form = new QFormLayout;
  form->addRow(title(say("Workspace")));
  scale_ = number(0.5, 6, 0.5, 1);
  scale_->setObjectName("scale");
  scale_->setSuffix(" ×");
  form->addRow(word(say("scale")), scale_);
  hand_ = choices({say("either hand"), say("left hand"), say("right hand")});
  form->addRow(word(say("held in")), hand_);
  second_ = choices({say("leads the tip elsewhere"), say("turns the body")});
  second_->setObjectName("second_button");
  form->addRow(word(say("second button")), second_);
  calibrate_ = button(say("The tip is here"), say("Brings the tip to the middle of the view, wherever the device is."));
  calibrate_->setObjectName("calibrate");
  form->addRow(calibrate_);
  column->addLayout(form);
  column->addStretch(1);

  connect(kind_, &QComboBox::activated, this,
          [this](int k) { set([&](DeviceSettings& now) { now.kind = static_cast<DeviceKind>(k); }); });
  connect(other_, &QComboBox::activated, this,
          [this](int k) { set([&](DeviceSettings& now) { now.other = kOthers[static_cast<std::size_t>(k)]; }); });
  connect(gain_, &QSlider::valueChanged, this,
          [this](int k) { set([&](DeviceSettings& now) { now.gain = k / 100.0; }); });
  connect(limit_, &QDoubleSpinBox::valueChanged, this,
          [this](double newtons) { set([&](DeviceSettings& now) { now.limit = newtons; }); });
  connect(scale_, &QDoubleSpinBox::valueChanged, this,
          [this](double scale) { set([&](DeviceSettings& now) { now.scale = scale; }); });
  connect(pull_, &QComboBox::activated, this,
          [this](int k) { set([&](DeviceSettings& now) { now.laws.pull = static_cast<PullLaw>(k); }); });
  connect(hand_, &QComboBox::activated, this,
          [this](int k) { set([&](DeviceSettings& now) { now.hand = static_cast<PointerSample::Hand>(k); }); });
  connect(second_, &QComboBox::activated, this,
          [this](int k) { set([&](DeviceSettings& now) { now.secondTurns = k == 1; }); });
  connect(off_, &QPushButton::clicked, this, [this](bool on) { force_.emergencyOff(on); });
  connect(test_, &QPushButton::clicked, this, [this] { force_.testFeel(); });
  connect(record_, &QPushButton::clicked, this, &DevicePanel::record);
  connect(calibrate_, &QPushButton::clicked, this, [this] { force_.calibrate(); });
  connect(look_, &QPushButton::clicked, this, [this] {
    QStringList lines;
    for (const auto& [device, what] : force_.look()) lines << inWords(device) + ": " + inWords(what);
    found_->setText(lines.join("\n"));
    found_->show();
  });
  connect(&force_, &ForceFeedback::changed, this, &DevicePanel::show);
  connect(&force_, &ForceFeedback::felt, this, [this] {
    if (isVisible()) showState();
  });
  Theme::here().keep(this, [this] { found_->hide(), show(); });
}

void DevicePanel::set(const std::function<void(DeviceSettings&)>& change) {
  if (filling_) return;
  DeviceSettings now = force_.settings();
  change(now);
  force_.set(now);
}

void DevicePanel::show() {
  filling_ = true;
  const DeviceSettings& now = force_.settings();
  kind_->setCurrentIndex(static_cast<int>(now.kind));
  other_->setCurrentIndex(static_cast<int>(std::find(kOthers.begin(), kOthers.end(), now.other) - kOthers.begin()));
  gain_->setValue(static_cast<int>(std::lround(100 * now.gain)));
  gainSaid_->setText(inWords(say("{0} % of the true force", gain_->value())));
  if (!limit_->hasFocus()) limit_->setValue(now.limit);
  if (!scale_->hasFocus()) scale_->setValue(now.scale);
  pull_->setCurrentIndex(static_cast<int>(now.laws.pull));
  hand_->setCurrentIndex(static_cast<int>(now.hand));
  second_->setCurrentIndex(now.secondTurns ? 1 : 0);
  for (const auto& [box, law] : laws_) box->setChecked(now.laws.*law);
  off_->setChecked(force_.isOff());
  const bool moves = now.kind == DeviceKind::Inverse3 || now.kind == DeviceKind::Touch;
  for (QWidget* one :
       {static_cast<QWidget*>(scale_), static_cast<QWidget*>(second_), static_cast<QWidget*>(calibrate_)})
    one->setEnabled(moves || !force_.there());
  test_->setEnabled(force_.there());
  record_->setEnabled(force_.there() || force_.recording());
  record_->setChecked(force_.recording());
  showState();
  filling_ = false;
}

void DevicePanel::record() {
  Done done;
  if (force_.recording()) {
    done = force_.endRecording();
  } else {
    const QString path = askToWrite(this, inWords(say("Record the hand")), "hand.txt", "*.txt", {"txt"});
    if (!path.isEmpty()) done = force_.record(path.toStdString());
  }
  show();  // a dialog that is left again leaves the button up
  if (!done) session_.refuse(done.error());
}

void DevicePanel::showState() {
  record_->setText(inWords(force_.recording()
                               ? say("Stop recording ({0} s)", static_cast<int>(force_.recording()->seconds()))
                               : say("Record the hand…")));
  const ServoTick tick = force_.last();
  const double newtons = length(tick.out.force), most = std::max(0.1, force_.limit());
  newtons_->setRange(0, static_cast<int>(kFineness * most));
  newtons_->setValue(std::min(newtons_->maximum(), static_cast<int>(kFineness * newtons)));
  newtonsSaid_->setText(QString::fromStdString(fixed(newtons, 2) + " N / " + fixed(force_.limit(), 1) + " N") +
                        (tick.limited ? "  " + inWords(say("at the limit")) : QString()));
  if (!force_.there()) {
    state_->setText(inWords(say("No device is used.")));
    return;
  }
  const Message why = ForceFeedback::said(tick.fault);
  state_->setText(force_.name() + "\n" +
                  (why.empty() || tick.state == ServoState::Armed
                       ? inWords(say("Force: {0}", ForceFeedback::said(tick.state)))
                       : inWords(say("Force: {0} ({1})", ForceFeedback::said(tick.state), why))));
}

}  // namespace karinui::studio
