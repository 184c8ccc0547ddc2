// What this process has begun to write and not completed. Who ends the process at once, from another thread,
// removes it first.
#pragma once

#include <functional>
#include <list>
#include <mutex>
#include <optional>

namespace voxmelt::io {

// Held while a place is made, renamed or removed: nobody discards it in the middle of that.
[[nodiscard]] std::unique_lock<std::mutex> changing_places();

// A partial file or folder, from its beginning until it is complete or gone.
class Unfinished {
 public:
  Unfinished() = default;
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  ~Unfinished();  // gone

  // Both while changing_places() is held.
  void begin(std::function<void()> discard);
  void complete();

 private:
  std::optional<std::list<std::function<void()>>::iterator> entry_;
};

// Removes all that is unfinished. No place changes any more: what follows must be the end of the process.
// Returns whether something was completed before.
bool discard_unfinished();

}  // namespace voxmelt::io
