#include "edge_numbers.h"

#include <QFormLayout>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <algorithm>

#include "karinui/pattern/symmetry.h"
#include "length_box.h"
#include "theme.h"
#include "variables_dialog.h"

namespace karinui::studio {

EdgeNumbers::EdgeNumbers(Session& session) : session_(session) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  const auto box = [form](const Message& words, double low, double metres) {
    auto* made = new LengthBox(words, low, 10);
    made->setMetres(metres);
    auto* label = new QLabel;
    Theme::here().keep(label, [label, words] { label->setText(inWords(words)); });
    form->addRow(label, made);
    return made;
  };
  along_ = box(say("Along the edge"), 0, 0.05);
  width_ = box(say("Dart, wide"), 0.001, session.toolOptions().dartWidth);
  depth_ = box(say("Dart, deep"), 0.001, 0.1);
  connect(width_, &LengthBox::typed, this, [this](double metres) {
    ToolOptions options = session_.toolOptions();
    options.dartWidth = metres;
    session_.setToolOptions(options);
  });
  const std::pair<LengthBox*, std::string*> kept[] = {{along_, &alongFormula_}, {width_, &widthFormula_}};
  for (const auto& [typed, formula] : kept) {
    typed->takeFormulas([this](const std::string& text) -> Result<double> {
      DocumentNames names = formulaNames(session_);
      const auto value = workedOut(text, names, kLength);
      if (!value) return value.error();
      return value->value;
    });
    connect(typed, &LengthBox::typed, this, [own = formula] { own->clear(); });
    connect(typed, &LengthBox::formulaTyped, this, [own = formula](const QString& text) { *own = text.toStdString(); });
  }
  auto* grid = new QGridLayout;
  const auto button = [&](int at, const Message& words, const Message& hint, Operation (EdgeNumbers::*what)() const) {
    auto* made = new QPushButton;
    Theme::here().keep(made, [made, words, hint] {
      made->setText(inWords(words));
      made->setToolTip(inWords(hint));
    });
    connect(made, &QPushButton::clicked, this, [this, what] {
      if (edge()) session_.perform((this->*what)());
    });
    grid->addWidget(made, at / 2, at % 2);
  };
  button(0, say("Point there"), say("Puts a point on the edge, which becomes two."), &EdgeNumbers::split);
  button(1, say("Take its end away"), say("Takes away the point at the edge's end."), &EdgeNumbers::join);
  button(2, say("Notch there"), say("Marks the place with a notch."), &EdgeNumbers::notch);
  button(3, say("Dart there"), say("Takes a wedge as wide and as deep out of the edge."), &EdgeNumbers::dart);
  form->addRow(grid);
}

const Edge* EdgeNumbers::edge() const {
  const auto& chosen = session_.selection().edge;
  const Piece* piece = chosen ? session_.snapshot().document.find(chosen->piece) : nullptr;
  return piece ? findEdge(*piece, chosen->edge) : nullptr;
}
EdgeRef EdgeNumbers::ref() const {
  return {PieceRef(session_.selection().edge->piece), session_.selection().edge->edge};
}
double EdgeNumbers::share() const { return std::clamp(along_->value() / edge()->curve.length(), 0.0, 1.0); }

Operation EdgeNumbers::withFormulas(Operation operation, bool width) const {
  if (!alongFormula_.empty())
    operation.formulas.push_back({"at", "(" + alongFormula_ + ")/[" + text(ref().piece.id) + "." + ref().edge + "]"});
  if (width && !widthFormula_.empty()) operation.formulas.push_back({"width", widthFormula_});
  return operation;
}

Operation EdgeNumbers::split() const { return withFormulas(SplitEdge{ref(), share()}, false); }
Operation EdgeNumbers::join() const { return JoinEdges{ref(), Choice::Auto, Choice::Yes}; }
Operation EdgeNumbers::notch() const {
  AddNotch notch;
  notch.edge = ref();
  notch.at = share();
  const Outline& outline = session_.snapshot().document.find(notch.edge.piece.id)->outline;
  const auto symmetry = symmetryOf(outline);
  const auto k = outline.find(notch.edge.edge);
  notch.symmetric = symmetry && k && imageOf(outline, *symmetry, {*k, notch.at});
  return withFormulas(notch, false);
}
Operation EdgeNumbers::dart() const {
  const Curve& curve = edge()->curve;
  AddDart dart;
  dart.edge = ref();
  dart.at = share();
  dart.width = {width_->value()};
  dart.tip = curve.atFraction(dart.at) +
             leftOf(normalized(curve.tangent(curve.parameterAt(dart.at * curve.length())))) * depth_->value();
  return withFormulas(dart, true);
}

}  // namespace karinui::studio
