#include "pose_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "angle_box.h"
#include "karinui/base/number.h"
#include "pose_view.h"
#include "theme.h"

namespace karinui::studio {

namespace {

int degrees(double radians) { return static_cast<int>(std::lround(radians / kDegree)); }

bool isSided(Joint joint) { return joint >= Joint::LeftShoulder; }
// The joint of the other side, of one that has sides.
Joint other(Joint joint) {
  const int j = static_cast<int>(joint);
  return static_cast<Joint>(j % 2 == 1 ? j + 1 : j - 1);
}

// Which way the three angles of a joint count (pose.h).
std::array<Message, 3> angleNames(Joint joint) {
  switch (joint) {
    case Joint::Pelvis:
    case Joint::Spine:
    case Joint::Neck:
      return {say("Forwards"), say("To the left"), say("Turned to the left")};
    case Joint::LeftElbow:
    case Joint::RightElbow:
      return {say("Bent"), {}, say("Forearm turned inwards")};
    case Joint::LeftKnee:
    case Joint::RightKnee:
      return {say("Bent"), {}, {}};
    case Joint::LeftWrist:
    case Joint::RightWrist:
      return {say("Towards the palm"), say("Towards the thumb"), {}};
    case Joint::LeftAnkle:
    case Joint::RightAnkle:
      return {say("Foot drawn up"), {}, {}};
    default:
      return {say("Forwards"), say("Sideways"), say("Turned inwards")};
  }
}

double& angleOf(JointAngles& angles, std::size_t k) {
  return k == 0 ? angles.flex : k == 1 ? angles.abduct : angles.turn;
}

}  // namespace

PoseDialog::PoseDialog(Session& session, QWidget* parent) : QDialog(parent), session_(session) {
  setObjectName("pose_dialog");
  setAttribute(Qt::WA_DeleteOnClose);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(16, 16, 16, 16);
  row->setSpacing(16);
  view_ = new PoseView;
  row->addWidget(view_, 3);
  auto* column = new QVBoxLayout;
  row->addLayout(column, 2);
  named_ = new QComboBox;
  joint_ = new QComboBox;
  both_ = new QCheckBox;
  column->addWidget(named_);
  column->addSpacing(8);
  column->addWidget(joint_);
  column->addWidget(both_);
  auto* grid = new QGridLayout;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    Row& one = rows_[k];
    one = {new QLabel, new QSlider(Qt::Horizontal), new AngleBox};
    one.slider->setMinimumWidth(150);
    const int at = static_cast<int>(k);
    grid->addWidget(one.name, 2 * at, 0, 1, 2);
    grid->addWidget(one.slider, 2 * at + 1, 0);
    grid->addWidget(one.box, 2 * at + 1, 1);
    connect(one.slider, &QSlider::valueChanged, one.box, &QSpinBox::setValue);
    connect(one.box, &QSpinBox::valueChanged, this, [this, &one](int now) {
      const bool inHand = one.slider->isSliderDown();
      one.slider->setValue(now);
      if (filling_) return;
      turned();
      if (!inHand) perform();
    });
    connect(one.box, &AngleBox::refused, this, [this](const Message& why) {
      refused_ = why;
      tell();
    });
    connect(one.slider, &QSlider::sliderReleased, this, &PoseDialog::perform);
  }
  column->addLayout(grid);
  said_ = new QLabel;
  said_->setObjectName("pose_said");
  said_->setWordWrap(true);
  said_->setProperty("role", "faint");
  column->addWidget(said_);
  column->addStretch(1);
  Theme::here().keep(this, [this] {
    tell();
    filling_ = true;
    setWindowTitle(inWords(say("Pose of the figure")));
    view_->setAccessibleName(inWords(say("Pose of the figure")));
    const int pose = named_->currentIndex(), joint = std::max(0, joint_->currentIndex());
    named_->clear();
    for (const NamedPose& one : namedPoses()) named_->addItem(inWords(one.said));
    named_->setPlaceholderText(inWords(say("Take a whole pose …")));
    named_->setAccessibleName(inWords(say("Pose")));
    named_->setCurrentIndex(pose);
    joint_->clear();
    for (std::size_t j = 0; j < kJoints; ++j) joint_->addItem(inWords(jointSaid(static_cast<Joint>(j))));
    joint_->setAccessibleName(inWords(say("Joint")));
    joint_->setCurrentIndex(joint);
    both_->setText(inWords(say("Both sides alike")));
    filling_ = false;
    showRows();
  });
  joint_->setCurrentIndex(static_cast<int>(Joint::LeftShoulder));
  connect(joint_, &QComboBox::currentIndexChanged, this, [this] {
    if (filling_) return;
    for (Row& one : rows_) one.box->setValue(one.box->value());  // what was typed was of another joint
    showRows();
  });
  connect(named_, &QComboBox::activated, this, [this](int which) {
    PoseBody take;
    take.name = std::string(namedPoses()[static_cast<std::size_t>(which)].name);
    session_.perform(take);
  });
  connect(view_, &PoseView::taken, this, [this](Joint joint) { joint_->setCurrentIndex(static_cast<int>(joint)); });
  connect(view_, &PoseView::dragged, this, [this](const BodyPose& pose) {
    pose_ = pose;
    showRows();
    if (both_->isChecked() && isSided(joint())) pose_[other(joint())] = anglesOf(joint());
    view_->show(pose_);
  });
  connect(view_, &PoseView::letGo, this, &PoseDialog::perform);
  refresh();
}

Joint PoseDialog::joint() const { return static_cast<Joint>(joint_->currentIndex()); }

std::vector<Joint> PoseDialog::joints() const {
  if (both_->isChecked() && isSided(joint())) return {joint(), other(joint())};
  return {joint()};
}

JointAngles PoseDialog::anglesOf(Joint joint) const {
  const auto stated = pose_.find(joint);
  return stated != pose_.end() ? stated->second : skeleton_ ? skeleton_->own(joint) : JointAngles();
}

void PoseDialog::refresh() {
  const BodyPtr& body = session_.snapshot().body;
  const bool works = body && !session_.readOnly();
  for (QWidget* part : {static_cast<QWidget*>(named_), static_cast<QWidget*>(joint_)}) part->setEnabled(works);
  const std::string now = body ? body->hash() : "-";
  const bool fresh = std::exchange(shownOn_, now) != now;
  if (fresh) {
    const BodyPtr own = body && body->ownKept() ? body->ownKept() : body;
    if (!own) {
      skeleton_.reset();
      about_ = say("There is no body yet; choose a figure in the body panel.");
      view_->setSkeleton(nullptr);
    } else if (!skeleton_ || skeleton_->body()->hash() != own->hash()) {
      const auto found = Skeleton::of(own);
      skeleton_ = found ? *found : nullptr;
      view_->setSkeleton(skeleton_);
      about_ = found
                   ? say("Drag a hand or a foot, and the limb swings; drag a forearm or a shin, and it bends. Dragged "
                         "elsewhere, or with the right button, the figure turns. What is let go is one step; the "
                         "garment follows.")
                   : found.error().what;
    }
    tell();
  }
  if (inHand()) return;
  if (waits_) {
    if (!session_.busy().posing) perform();
    return showRows();
  }
  // A step under way will bring what was let go.
  if (const BodyPose& stands = session_.snapshot().document.body.pose; fresh || !session_.busy().any)
    if (fresh || pose_ != stands) view_->show(pose_ = stands);
  showRows();
}

bool PoseDialog::inHand() const {
  return view_->held() ||
         std::any_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.slider->isSliderDown(); });
}

void PoseDialog::showRows() {
  filling_ = true;
  const bool works = skeleton_ && !session_.readOnly();
  const auto names = angleNames(joint());
  JointAngles now = anglesOf(joint());
  auto [least, most] = limitsOf(joint());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    Row& row = rows_[k];
    const bool has = angleOf(most, k) > angleOf(least, k);
    row.name->setText(inWords(names[k]));
    for (QWidget* part : {static_cast<QWidget*>(row.slider), static_cast<QWidget*>(row.box)})
      part->setAccessibleName(inWords(names[k]));
    for (QWidget* part :
         {static_cast<QWidget*>(row.name), static_cast<QWidget*>(row.slider), static_cast<QWidget*>(row.box)})
      part->setVisible(has), part->setEnabled(works);
    if (!has) continue;
    row.slider->setRange(degrees(angleOf(least, k)), degrees(angleOf(most, k)));
    row.box->setRange(degrees(angleOf(least, k)), degrees(angleOf(most, k)));
    row.slider->setValue(degrees(angleOf(now, k)));
    if (!row.box->typing()) row.box->setValue(degrees(angleOf(now, k)));
  }
  both_->setEnabled(works && isSided(joint()));
  filling_ = false;
}

void PoseDialog::turned() {
  if (!skeleton_) return;
  JointAngles now = anglesOf(joint());
  // What was not moved keeps its own fractions of a degree.
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (rows_[k].box->isVisible() && rows_[k].box->value() != degrees(angleOf(now, k)))
      angleOf(now, k) = rows_[k].box->value() * kDegree;
  for (const Joint one : joints()) pose_[one] = now;
  view_->show(pose_);
}

// What was refused stands there until something is turned; else what can be done here.
void PoseDialog::tell() { said_->setText(inWords(refused_.empty() ? about_ : refused_)); }

void PoseDialog::perform() {
  if (!skeleton_) return;
  refused_ = {};
  tell();
  waits_ = session_.busy().posing;  // the figure goes on from where it comes to stand
  if (waits_) return;
  const BodyPose& stands = session_.snapshot().document.body.pose;
  JointAngles now = anglesOf(joint()), was = skeleton_->own(joint());
  if (const auto stated = stands.find(joint()); stated != stands.end()) was = stated->second;
  auto [least, most] = limitsOf(joint());
  PoseBody take;
  std::array<std::optional<Angle>*, 3> fields{&take.flex, &take.abduct, &take.turn};
  for (std::size_t k = 0; k < fields.size(); ++k)
    if (angleOf(most, k) > angleOf(least, k) &&
        (degrees(angleOf(now, k)) != degrees(angleOf(was, k)) || both_->isChecked()))
      *fields[k] = Angle{degrees(angleOf(now, k)) * kDegree};
  if (!take.flex && !take.abduct && !take.turn) return refresh();
  for (const Joint one : joints()) take.joint.emplace_back(jointNames()[static_cast<std::size_t>(one)]);
  session_.perform(take);
}

}  // namespace karinui::studio
