#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "file_filter.h"
#include "fit_study.h"
#include "karinui/base/number.h"
#include "karinui/session/animation.h"
#include "theme.h"
#include "worn_figure.h"

namespace karinui::studio {

namespace {

Message motionCell(const std::string& plain) { return say("{0}", plain); }

StudyItem motionItem(const FitInPose& fit) {
  const auto percent = [](double share) { return motionCell(fixed(share * 100, 1) + " %"); };
  const auto kilo = [](double pascals) { return motionCell(fixed(pascals / 1000, 2) + " kPa"); };
  StudyItem item;
  item.name = fit.said;
  if (fit.refused) {
    item.cells.push_back(say("cannot be taken"));
    item.below.push_back(*fit.refused), item.marked = true;
    return item;
  }
  item.cells = {percent(fit.strain.mean), percent(fit.strain.p99), percent(fit.strain.max),
                fit.pressure ? kilo(fit.pressure->mean) : motionCell("–"),
                fit.pressure ? kilo(fit.pressure->p99) : motionCell("–")};
  for (const auto& slid : fit.slid)
    item.cells.push_back(slid ? motionCell((*slid >= 0.0005 ? "+" : "") + lengthText(*slid).toStdString())
                              : motionCell("–"));
  if (!fit.settled) item.below.push_back(say("did not settle")), item.marked = true;
  item.garment = fit.garment, item.pressure = fit.pressureAt;
  return item;
}

}  // namespace

MotionStudy::MotionStudy(Session& session, QWidget* parent)
    : FitStudy(session, parent, say("Fit in motion"),
               say("A copy of the garment is brought to rest in each pose that is ticked. Edges slide over the skin: "
                   "up, or towards the trunk, is plus. The garment is left as it is.")),
      garment_(session.shownPtr()) {
  setObjectName("motion_study");
  static constexpr std::string_view kUsual[] = {"T", "forward", "seated", "step"};
  for (const NamedPose& pose : namedPoses())
    choice(pose.said, std::find(std::begin(kUsual), std::end(kUsual), pose.name) != std::end(kUsual));
  saveAnimation_ = new QPushButton(inWords(say("Save an animation…")));
  saveAnimation_->setObjectName("study_animation");
  saveAnimation_->setToolTip(inWords(
      say("How the garment goes through the poses that are ticked, one after another, for 3D programs (GLB).")));
  saveAnimation_->setAutoDefault(false);
  saves().addWidget(saveAnimation_);
  connect(saveAnimation_, &QPushButton::clicked, this, &MotionStudy::askAnimation);
  connect(this, &FitStudy::ready, saveAnimation_, &QWidget::setEnabled);
}

std::vector<std::string> MotionStudy::poses() const {
  std::vector<std::string> all;
  for (const std::size_t k : ticked()) all.emplace_back(namedPoses()[k].name);
  return all;
}

void MotionStudy::askAnimation() {
  const QString name = QString::fromStdString(session_.path().stem().string());
  const QString path = askToWrite(this, windowTitle(), name + ".glb", "GLB (*.glb)", {"glb"});
  if (!path.isEmpty()) saveAnimation(path.toStdString());
}

void MotionStudy::saveAnimation(const std::string& file) {
  beginBeside([garment = garment_, poses = poses(), file](Workers& workers, const Token& token) -> Result<Message> {
    WornFigure figure(garment->body);
    Bodies bodies;
    Context context{workers, token, figure, bodies, {}, {}};
    const auto written = writeAnimation(file, garment->document, poses, context, printsOf(*garment));
    return written ? Result<Message>(say("“{0}” was written.", file)) : written.error();
  });
}

Message MotionStudy::faulty(std::size_t many) const {
  for (const StudyItem& item : items())
    if (!item.garment) return say("Done, but: {0}", item.below.front());
  return say("Done; {0} of {1} did not come to rest.", many, items().size());
}

void MotionStudy::go() {
  std::vector<Message> columns{say("Pose"), say("Stretch, mean"),  say("99 %"),
                               say("most"), say("Pressure, mean"), say("99 %")};
  for (const OpenEdge edge : kOpenEdges) columns.push_back(openEdgeSaid(edge));
  begin(ticked().size() + 1, columns,
        [garment = garment_, poses = poses()](Workers& workers, const Token& token,
                                              const Tell& tell) -> Result<std::string> {
          WornFigure figure(garment->body);
          Bodies bodies;
          Context context{workers, token, figure, bodies, {}, {}};
          const auto fits =
              fitInMotion(garment->document, poses, context, [&](const FitInPose& fit) { tell(motionItem(fit)); });
          if (!fits) return fits.error();
          return csvOf(*fits);
        });
}

}  // namespace karinui::studio
