#pragma once
// SQLite's file layer with a test in between: told of every call that opens, reads or changes a file before it is made,
// it may refuse it. Nothing waits for the real disk: xSync is only told.
#include <sqlite3.h>

#include <cstring>
#include <string>
#include <string_view>

namespace karinui {

// The default layer while it lives; one at a time. Every hook gives SQLITE_OK to let the call go on.
class FileLayer {
 public:
  FileLayer() {
    sqlite3_initialize();
    real_ = sqlite3_vfs_find(nullptr);
    layer_ = *real_;
    layer_.zName = "test";
    layer_.pAppData = this;
    layer_.szOsFile = static_cast<int>(sizeof(File)) + real_->szOsFile;
    layer_.xOpen = [](sqlite3_vfs* vfs, const char* path, sqlite3_file* file, int flags, int* got) {
      FileLayer& layer = *static_cast<FileLayer*>(vfs->pAppData);
      sqlite3_vfs* real = layer.real_;
      File& opened = *reinterpret_cast<File*>(file);
      opened = {{nullptr}, &layer, path};
      std::memset(opened.whole(), 0, static_cast<std::size_t>(real->szOsFile));
      int there = 1;
      if (path) (void)real->xAccess(real, path, SQLITE_ACCESS_EXISTS, &there);
      if ((flags & SQLITE_OPEN_CREATE) != 0)
        if (const int code = layer.onCreate(path ? path : "", there == 0); code != SQLITE_OK) return code;
      if ((flags & SQLITE_OPEN_CREATE) == 0)
        if (const int code = layer.onOpen(path ? path : ""); code != SQLITE_OK) return code;
      const int done = real->xOpen(real, path, opened.whole(), flags, got);
      if (opened.whole()->pMethods) file->pMethods = &methods();
      return done;
    };
    layer_.xDelete = [](sqlite3_vfs* vfs, const char* path, int sync) {
      FileLayer& layer = *static_cast<FileLayer*>(vfs->pAppData);
      const int code = layer.onDelete(path, sync != 0);
      return code == SQLITE_OK ? layer.real_->xDelete(layer.real_, path, 0) : code;
    };
    sqlite3_vfs_register(&layer_, 1);
  }
  virtual ~FileLayer() {
    sqlite3_vfs_unregister(&layer_);
    sqlite3_vfs_register(real_, 1);
  }
  FileLayer(const FileLayer&) = delete;
  FileLayer& operator=(const FileLayer&) = delete;

 protected:
  // Path; whether it is not there yet, of a file that may be made.
  virtual int onCreate(std::string_view, bool) { return SQLITE_OK; }
  virtual int onOpen(std::string_view) { return SQLITE_OK; }  // of a file that must be there
  virtual int onRead(std::string_view) { return SQLITE_OK; }
  virtual int onSize(std::string_view) { return SQLITE_OK; }
  // Path, bytes, place; and how many of the bytes are written where the answer is not SQLITE_OK.
  virtual int onWrite(std::string_view, std::string_view, sqlite3_int64, int&) { return SQLITE_OK; }
  virtual int onTruncate(std::string_view, sqlite3_int64) { return SQLITE_OK; }
  virtual int onSync(std::string_view) { return SQLITE_OK; }
  virtual int onDelete(std::string_view, bool) { return SQLITE_OK; }  // path, and whether the folder is synced
  virtual int onLock(std::string_view, int) { return SQLITE_OK; }
  virtual int characteristics(int ofDisk) const { return ofDisk; }

 private:
  struct File {
    sqlite3_file base;
    FileLayer* layer;
    const char* path;  // SQLite keeps it as long as the file
    sqlite3_file* whole() { return reinterpret_cast<sqlite3_file*>(this + 1); }
    std::string_view name() const { return path ? path : ""; }
  };
  static File& of(sqlite3_file* file) { return *reinterpret_cast<File*>(file); }
  static sqlite3_file* in(sqlite3_file* file) { return of(file).whole(); }

  static const sqlite3_io_methods& methods();

  sqlite3_vfs* real_ = nullptr;
  sqlite3_vfs layer_{};
};

// Not in the class: there g++ 12 calls virtual functions of a class that is not complete yet as if they were not
// virtual.
inline const sqlite3_io_methods& FileLayer::methods() {
  static const sqlite3_io_methods all = [] {
    sqlite3_io_methods m{};
    m.iVersion = 1;
    m.xClose = [](sqlite3_file* f) { return in(f)->pMethods->xClose(in(f)); };
    m.xRead = [](sqlite3_file* f, void* to, int size, sqlite3_int64 at) {
      const int code = of(f).layer->onRead(of(f).name());
      return code == SQLITE_OK ? in(f)->pMethods->xRead(in(f), to, size, at) : code;
    };
    m.xWrite = [](sqlite3_file* f, const void* from, int size, sqlite3_int64 at) {
      int taken = 0;
      const std::string_view bytes(static_cast<const char*>(from), static_cast<std::size_t>(size));
      const int code = of(f).layer->onWrite(of(f).name(), bytes, at, taken);
      if (code == SQLITE_OK) return in(f)->pMethods->xWrite(in(f), from, size, at);
      if (taken > 0) (void)in(f)->pMethods->xWrite(in(f), from, taken, at);
      return code;
    };
    m.xTruncate = [](sqlite3_file* f, sqlite3_int64 size) {
      const int code = of(f).layer->onTruncate(of(f).name(), size);
      return code == SQLITE_OK ? in(f)->pMethods->xTruncate(in(f), size) : code;
    };
    m.xSync = [](sqlite3_file* f, int) { return of(f).layer->onSync(of(f).name()); };
    m.xFileSize = [](sqlite3_file* f, sqlite3_int64* size) {
      const int code = of(f).layer->onSize(of(f).name());
      return code == SQLITE_OK ? in(f)->pMethods->xFileSize(in(f), size) : code;
    };
    m.xLock = [](sqlite3_file* f, int how) {
      const int code = of(f).layer->onLock(of(f).name(), how);
      return code == SQLITE_OK ? in(f)->pMethods->xLock(in(f), how) : code;
    };
    m.xUnlock = [](sqlite3_file* f, int how) { return in(f)->pMethods->xUnlock(in(f), how); };
    m.xCheckReservedLock = [](sqlite3_file* f, int* is) { return in(f)->pMethods->xCheckReservedLock(in(f), is); };
    m.xFileControl = [](sqlite3_file* f, int what, void* with) {
      return in(f)->pMethods->xFileControl(in(f), what, with);
    };
    m.xSectorSize = [](sqlite3_file* f) { return in(f)->pMethods->xSectorSize(in(f)); };
    m.xDeviceCharacteristics = [](sqlite3_file* f) {
      return of(f).layer->characteristics(in(f)->pMethods->xDeviceCharacteristics(in(f)));
    };
    return m;
  }();
  return all;
}

}  // namespace karinui
