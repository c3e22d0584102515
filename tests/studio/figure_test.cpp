// The board of the figure in the real window: turned, let go, taken back.
#include <gmock/gmock.h>

#include <QSlider>
#include <QStyleOptionSlider>

#include "studio/window.h"

namespace karinui::studio {
namespace {

QPointF knobOf(const QSlider& slider) {
  QStyleOptionSlider option;
  option.initFrom(&slider);
  option.orientation = Qt::Horizontal;
  option.minimum = slider.minimum(), option.maximum = slider.maximum();
  option.sliderPosition = option.sliderValue = slider.value();
  return slider.style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, &slider).center();
}

TEST(StudioFigure, FollowsASliderAndTheGarmentIsMadeAgain) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(1);
  w.rest();
  const std::size_t steps = w.count();
  const auto bust = [](const Fitting& f) { return f.body->measured().value.at("bust_girth"); };
  const auto chest = [&] { return w.session().fitting().document.pieceNamed("front")->outline.area(); };
  const double girth = bust(w.session().fitting()), area = chest();
  QSlider* slider = nullptr;
  for (QSlider* one : w.main().findChildren<QSlider*>())
    if (one->accessibleName() == "bust girth") slider = one;
  ASSERT_TRUE(slider);
  const QPointF knob = knobOf(*slider);
  w.drag(*slider, {knob, knob + QPointF(slider->width() * 0.12, 0)}, {}, [&] {
    w.session().finish();
    w.keep("studio_figure");
    EXPECT_GT(bust(w.session().shown()), girth + 0.02) << "the figure is seen at once";
    EXPECT_EQ(w.count(), steps);
    EXPECT_EQ(bust(w.session().fitting()), girth) << "nothing is done before it is let go";
  });
  w.rest();
  EXPECT_EQ(w.count(), steps) << w.main().said().toStdString();
  EXPECT_GT(bust(w.session().fitting()), girth + 0.02);
  EXPECT_GT(chest(), 1.01 * area) << "the garment was drawn anew on it";
  EXPECT_TRUE(w.session().fitting().document.drape.last->settled) << "and hangs";
  w.key(Command::Undo);
  w.rest();
  EXPECT_EQ(bust(w.session().fitting()), girth);
  EXPECT_EQ(chest(), area);
  EXPECT_EQ(w.box("bust girth").text().toStdString(), "–") << "the board says what is worn";
}

}  // namespace
}  // namespace karinui::studio
