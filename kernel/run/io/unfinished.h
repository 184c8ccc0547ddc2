// This process knows which files and folders it has begun to write and not completed. A thread that ends the
// process at once removes them first.
#pragma once

#include <functional>
#include <list>
#include <mutex>
#include <optional>

namespace voxmelt::io {

// Locks all changes of places. It is held while a place is made, renamed or removed, so that nobody discards
// it meanwhile.
[[nodiscard]] std::unique_lock<std::mutex> changing_places();

// Is a partial file or folder, from its beginning until it is complete or gone.
class Unfinished {
 public:
  Unfinished() = default;
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  ~Unfinished();  // the partial file or folder is gone

  // Both are called while changing_places() is held.
  void begin(std::function<void()> discard);
  void complete();

 private:
  std::optional<std::list<std::function<void()>>::iterator> entry_;
};

// Removes all that is unfinished. No place changes any more, so the process must end next. It returns true if
// something was completed before.
bool discard_unfinished();

}  // namespace voxmelt::io
