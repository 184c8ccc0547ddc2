// The finished contents of a folder take the place of older ones. If the folder itself cannot be renamed, its
// entries are moved one by one. A process that dies meanwhile leaves what the next one completes.
#pragma once

#include <filesystem>
#include <string>

namespace voxmelt::io {

inline constexpr const char* kMarker = ".voxmelt-output";           // lists the files of a complete output
inline constexpr const char* kPartialWithin = ".voxmelt.partial-";  // begins the name of one within its place
inline constexpr const char* kIncompleteWithin = "incomplete";      // an incomplete output within its place

// Tells if a folder must stay where it is: something is mounted on it, or nothing can be made beside it.
bool must_stay(const std::filesystem::path& place);

// Tells if an entry of a place is no part of its contents: a partial output, or an incomplete one.
bool is_beside_contents(const std::filesystem::path& place, const std::string& name);

// Puts `fresh`, which has its marker, at `place`, and the old contents at `fresh`. Returns 0, or errno with
// everything as it was.
int exchange(const std::filesystem::path& fresh, const std::filesystem::path& place);

// Moves the entries of `fresh` to `place`, which is on the same file system. The old ones go. Returns 0, or
// errno; then another call goes on. A place that is not there is made.
int move_entries(const std::filesystem::path& fresh, const std::filesystem::path& place);

// Tells if a process died while it moved these entries.
bool is_half_moved(const std::filesystem::path& fresh);

}  // namespace voxmelt::io
