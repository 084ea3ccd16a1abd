#include "StandardStreams.h"

#include <fcntl.h>
#include <unistd.h>

namespace weft {

void fillClosedStreams() {
  // Each open() takes the lowest free number, which is the one that was found closed.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

bool printText(std::FILE* stream, std::string_view text) {
  return std::fwrite(text.data(), 1, text.size(), stream) == text.size() && std::fflush(stream) == 0;
}

}  // namespace weft
