// SPDX-License-Identifier: BSL-1.0
// Looks at the standard output when a program ends; part of every example.
#include <cstdio>
#include <cstdlib>

#ifdef __GLIBC__
#include <fcntl.h>

namespace {

/// A program whose output was lost, for example on a full disk, does not end with 0. Output that is closed from the
/// start is lost on purpose.
void require_output(int status, void*) {
  if (status != 0 || (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)) return;
  std::fputs("error: the standard output cannot be written, see the disk that it goes to; other files are complete\n",
             stderr);
  std::_Exit(1);
}

[[maybe_unused]] int const registered = ::fcntl(1, F_GETFD) == -1 ? 0 : ::on_exit(require_output, nullptr);

}  // namespace
#endif
