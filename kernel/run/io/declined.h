// Mounts of other systems decline what only makes a file safer or nicer: a mode, a flush, a lock, an exchange
// of folders. Work goes on without it.
#pragma once

#include <cerrno>

namespace voxmelt::io {

// Tells if a file system does not know the operation, or does not allow it. It is false for an error that may
// lose bytes.
constexpr bool is_declined(int error) {
  return error == EINVAL || error == ENOSYS || error == EOPNOTSUPP || error == EPERM || error == EACCES ||
         error == EROFS || error == ENOTTY || error == ENOLCK;
}

}  // namespace voxmelt::io
