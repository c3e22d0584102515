#include "measures_file.h"

#include "karinui/base/file.h"
#include "karinui/design/glossary.h"
#include "karinui/exchange/measurement_files.h"
#include "karinui/session/fit_over_bodies.h"

namespace karinui::studio {

void wearMeasures(Session& session, const std::filesystem::path& file) {
  const auto read = readMeasures(file);
  if (!read) return session.refuse(read.error());
  const Measurements made = forMannequin(read->measures);
  if (made.value.empty()) return session.refuse(refused(say("There are no measures in this file.")));
  session.applyFigure(figureOf(made));
  std::vector<Message> left;
  for (const auto& [key, value] : read->measures.value)
    if (!made.value.contains(key)) left.push_back(identifierSaid(key).value_or(say("{0}", key)));
  for (const auto& unread : read->unread) left.push_back(say("{0}", unread.name));
  for (const std::string& name : read->unknown) left.push_back(say("{0}", name));
  constexpr std::size_t kMostNamed = 6;
  const std::size_t more = left.size() > kMostNamed ? left.size() - kMostNamed : 0;
  left.resize(left.size() - more);
  if (more > 0) left.push_back(say("{0} more", more));
  if (!left.empty()) session.advise(say("Left out, as no mannequin can be made to it: {0}.", listSaid(left)));
}

void saveMeasures(Session& session, const std::filesystem::path& file) {
  const BodyPtr body = session.snapshot().body;
  if (!body)
    return session.refuse(refused(say("There is no body yet; choose one first, for example: body size=jis9ar.")));
  Measurements all = body->measured();
  const Measurements& typed = session.snapshot().document.body.measurements;
  all.sex = typed.sex;
  for (const auto& [key, value] : typed.value) all.value[key] = value;
  const auto bytes = writtenMeasures(file, all);
  if (!bytes) return session.refuse(bytes.error());
  if (Done done = writeFile(file, *bytes); !done) session.refuse(done.error());
}

}  // namespace karinui::studio
