#pragma once
// What a DocumentFile holds: the steps of all branches, the documents they led to, and the file that keeps both.
#include "design/document_parts.h"
#include "design/file/store.h"
#include "karinui/design/history.h"

namespace karinui {

// Names the step an error comes from.
Error atStep(std::size_t serial, const Error& error);

struct DocumentFile::Inside {
  std::optional<Store> store;  // nothing: in memory only
  MemoryBlobs memory;          // blobs of a document without a file
  std::vector<Step> steps;     // all branches, by seq
  Head head;
  std::map<std::uint64_t, Document> documents;  // after a step, by seq; 0 is the empty one
  std::filesystem::path path;
  std::vector<Message> remarks;
  KeptParts keptParts;

  // The file's blobs as the rest of the program sees them.
  struct FileBlobs : Blobs {
    Inside* in;
    explicit FileBlobs(Inside* i) : in(i) {}
    Result<std::string> put(std::string bytes) override {
      if (!in->store) return in->memory.put(std::move(bytes));
      if (Done done = in->writable(); !done) return done.error();
      std::string name = blobName(bytes);
      if (in->store->blob(name)) return name;
      if (Done done = in->store->keep(name, bytes); !done) return done.error();
      return name;
    }
    Result<std::string> get(const std::string& name) const override {
      return in->store ? in->store->blob(name) : in->memory.get(name);
    }
    Result<std::string> figure(const std::string& hash) const override {
      const std::string* name = in->keptParts.figure(hash);
      if (!name) return Blobs::figure(hash);
      auto bytes = get(*name);
      if (!bytes) in->keptParts.lost(hash);  // or damaged: kept anew with the next step
      return bytes;
    }
  } blobs{this};

  // The file's blobs first, then the caller's; what the caller had to give is remembered, to be kept with the step.
  struct Borrowing : Blobs {
    Blobs* own;
    Blobs* other;
    mutable std::map<std::string, std::string> borrowed;
    Borrowing(Blobs* o, Blobs* t) : own(o), other(t) {}
    Result<std::string> put(std::string bytes) override { return own->put(std::move(bytes)); }
    Result<std::string> get(const std::string& name) const override {
      auto mine = own->get(name);
      if (mine || other == own) return mine;
      auto theirs = other->get(name);
      if (theirs) borrowed[name] = *theirs;
      return theirs ? theirs : mine;
    }
    Result<std::string> figure(const std::string& hash) const override {
      auto mine = own->figure(hash);
      return mine || other == own ? mine : other->figure(hash);
    }
  };

  Done writable() const;
  const Step* step(std::uint64_t seq) const;  // null: no such step
  // From the beginning (left out) to a step.
  std::vector<const Step*> line(std::uint64_t seq) const;

  // The document kept beside a step, if it is whole, sound and matches the step's hashes.
  std::optional<Document> kept(const Step& s);

  // The document after a step: known, kept beside it, or made again from the nearest one before it.
  Result<const Document*> documentAt(std::uint64_t seq, Context& context);

  Done begin(Store opened, Context* how);
  // Compares what is kept beside every step with what the step says of it, and remarks what differs.
  void compareKept();
  // Takes every step that is quickly taken once more, from what is kept before it, and remarks where that leads
  // elsewhere.
  Done compareSteps(Context& context);

  // What this very operation made of this very garment before, on whatever branch: nothing that a drape depends on lies
  // outside the two (apply() is pure), so that nobody waits for it twice. Null: it was not done yet, or is not kept.
  const Document* madeBefore(const Step* parent, const Document& before, const Operation& operation);
  const Document* keptAt(std::uint64_t seq);  // null: it would have to be made again

  struct Worked;
  std::uint64_t nextSeq() const { return steps.empty() ? 1 : steps.back().seq + 1; }
  Result<Worked> work(const Step* parent, const Document& before, std::uint64_t seq, Operation operation,
                      Context& context);
  Done keep(Worked worked, Head then, const Bodies& bodies);
  Done stand(Head there);
  void forget();
};

// One step worked out on the document before it, and what keeping it needs.
struct DocumentFile::Inside::Worked {
  Step step;
  Document after;
  std::map<std::string, std::string> borrowed;  // blobs of the caller's that it used
};

}  // namespace karinui
