// The changes that a scene makes while it runs: [[change]]. Here they are texts: whoever steps knows the
// words.
#pragma once

#include <string>
#include <vector>

#include "kernel/scene/scene.h"
#include "kernel/scene/text/document.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::scene {

// Reads them, in the order of their steps. Those of one step stay in the order of the file. It throws
// InputError.
std::vector<Change> read_timeline(Reader& root);

// Returns a document as text that means the same in any folder: files have their whole paths.
std::string portable_text(Value document);

// Returns the text of a scene with more changes, whose steps count from its first one. They come before its
// own ones of the same step.
std::string with_timeline(const std::string& text, const std::vector<Change>& more);

}  // namespace voxmelt::scene
