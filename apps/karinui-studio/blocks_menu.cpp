#include "blocks_menu.h"

#include <QMenu>

#include "karinui/design/block_numbers.h"
#include "karinui/design/glossary.h"
#include "theme.h"

namespace karinui::studio {

void fillBlocks(QMenu& menu, Session& session, std::function<void()> numbers) {
  using Kind = DraftBlock::Kind;
  static constexpr std::pair<Kind, const char*> kinds[] = {
      {Kind::Shirt, "shirt"}, {Kind::Bodice, "bodice"},     {Kind::Sleeve, "sleeve"},    {Kind::Collar, "collar"},
      {Kind::Skirt, "skirt"}, {Kind::Trousers, "trousers"}, {Kind::Leggings, "leggings"}};
  menu.setObjectName("blocks");
  for (const auto& [kind, name] : kinds) {
    QAction* action = menu.addAction(QString());
    action->setObjectName(QString("block_") + name);
    Theme::here().keep(action, [action, name = name] { action->setText(inWords(*termSaid(Term::Value, name))); });
    QObject::connect(action, &QAction::triggered, &menu, [&session, kind = kind] {
      DraftBlock block;
      block.kind = kind;
      block = wornOver(session.snapshot().document, std::move(block));
      if (!block.prefix.empty()) session.advise(wornOverSaid(block));
      session.perform(std::move(block));
    });
  }
  QAction* typed = menu.addAction(QString());
  typed->setObjectName("block_numbers");
  Theme::here().keep(typed, [typed] { typed->setText(inWords(say("With ease and length…"))); });
  QObject::connect(typed, &QAction::triggered, &menu, std::move(numbers));
  QObject::connect(&menu, &QMenu::aboutToShow, &menu, [&menu, &session] {
    const bool can = session.snapshot().document.body.chosen() && !session.readOnly();
    for (QAction* action : menu.actions()) action->setEnabled(can);
  });
}

}  // namespace karinui::studio
