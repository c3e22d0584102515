#pragma once
// The steps that led to a garment, undo and redo; and the .karinui file that keeps them. One owner, one thread at a
// time.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "karinui/design/apply.h"

namespace karinui {

struct Step {
  std::uint64_t seq = 0;      // never reused, over all branches; 0: the empty beginning
  std::uint64_t parent = 0;   // the step before
  std::uint32_t serial = 0;   // how many steps from the beginning, itself included; ids are minted from it
  Operation operation;        // as recorded: ids only
  std::string chain;          // hash of all operations up to here
  std::string before, after;  // hash(document) before and after
  std::string stand;          // drapeHash(document) after
};

// A step's operation, to be done again on what may be another garment: what an older program left open is done as it
// was done then, and not as it is by now.
Operation asRecorded(Operation operation);

// A document that lives in a file. Each operation is one transaction: when perform() returns a value it is on the disk,
// and no crash or power cut loses it. Undo and redo survive closing. Undone steps stay in the file as a branch after
// new work.
class DocumentFile {
 public:
  // A new file; refuses to overwrite one.
  static Result<DocumentFile> create(const std::filesystem::path& path);
  // Opens for work. Damaged, foreign, newer, locked or unwritable files are refused with a sentence; nothing is
  // changed. Every step is kept with the document it led to, drapes included, so that opening does not compute; a kept
  // document that is missing or does not match its hash is made again by replaying, with `how` (nothing: one quiet
  // thread). One that an older program left is taken as it is: a person's drape does not change because the program
  // did.
  static Result<DocumentFile> open(const std::filesystem::path& path, Context* how = nullptr);
  // The same for reading only: what may not be written, or what should not be. perform, undo and redo are then refused.
  static Result<DocumentFile> openForReading(const std::filesystem::path& path, Context* how = nullptr);
  // A document without a file (tests, import previews).
  static DocumentFile inMemory();

  DocumentFile(DocumentFile&&) noexcept;
  DocumentFile& operator=(DocumentFile&&) noexcept;
  ~DocumentFile();  // closes; leaves one single file

  const Document& document() const;  // at the head
  std::vector<Step> steps() const;   // from the beginning to the head
  std::vector<Step> undone() const;  // what redo would bring back, in order
  const std::filesystem::path& path() const;
  bool moved() const;  // the file was moved, renamed or deleted since it was opened: path() is not where it is
  // The whole file as it is kept, also where it was moved or deleted since. Refused without a file.
  Result<std::string> bytes() const;
  // What was found while reading that a person should know: kept parts that were damaged and made again from the steps,
  // steps that do not follow from each other or lead elsewhere than the file says. Opening compares what is kept beside
  // every step with that step's hashes. Empty for a file as it was written.
  const std::vector<Message>& remarks() const;
  // Takes every step once more from what is kept before it, but for drapes, pulls and poses, and remarks where that
  // leads elsewhere than to what is kept: somebody changed the operation, or another program took it. Every figure that
  // is kept is made once more, too, from its measures or its imported body: that takes a while, and opening does not.
  Done checkSteps(Context& context);
  Blobs& blobs();

  // Resolves, applies and records. On any error nothing has changed, in memory or on disk. The context's own blobs are
  // asked for what the file does not have yet (an imported body); what was used is kept in the file.
  Result<Step> perform(Operation operation, Context& context);
  // The step that was undone (done again). Refused where there is nothing left to undo (redo).
  Result<Step> undo(Context& context);
  Result<Step> redo(Context& context);

  // --- the whole tree of steps, for going back and changing one's mind
  // The garment after a step of any branch; 0: the empty beginning.
  Result<Document> documentAfter(std::uint64_t seq, Context& context);
  // Stands at a step of any branch. On the present one redo still walks on to its end.
  Done goTo(std::uint64_t seq, Context& context);
  // The last steps of the branches that were left, newest first.
  std::vector<Step> otherBranches() const;
  // The garment as if step `which` (from 1) had been this operation: it and all that came after it up to the head are
  // played again, on a branch of their own that begins before it. All or nothing: when one is refused, or it is
  // cancelled, the error names the step and nothing has changed.
  Done amend(std::size_t which, Operation operation, Context& context);

  // The text that play reads: one operation a line from the beginning to the head.
  std::string log() const;

 private:
  struct Inside;
  explicit DocumentFile(std::unique_ptr<Inside> inside);
  std::unique_ptr<Inside> inside_;
};

// After a document came to lie where another one was: what a program that fell down left beside that one would be taken
// for the new one's.
void dropJournal(const std::filesystem::path& path);

// What is whole of a damaged file, in a new one: every step that is as it was written and follows from whole ones,
// what is kept beside them, and the head, or the newest whole step where the head is lost. Refused when there is not
// one whole step, or `to` exists already; `from` is only read. What is kept beside a step and damaged is made again.
struct Rescued {
  std::size_t steps = 0;  // kept, of all branches
  std::size_t lost = 0;   // rows that were there and could not be kept
  // Not 0: a later garment was still kept beside steps that are lost. It was made anew by so many steps of its own,
  // without its history, its formulas and its drape; no step was kept.
  std::size_t anew = 0;
  std::vector<Message> remarks;  // of checkSteps() on what was kept
};
Message rescuedSaid(const Rescued& rescued);
Result<Rescued> rescue(const std::filesystem::path& from, const std::filesystem::path& to, Context& context);

}  // namespace karinui
