#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <string>

namespace weft::test {

/// A display in memory (Xvfb) for windows of this process, as long as it lives.
class XServer {
 public:
  /// Null where Xvfb is not installed or does not start; otherwise $DISPLAY names it.
  static std::unique_ptr<XServer> start() {
    int ends[2];
    if (pipe(ends) != 0) return nullptr;
    const pid_t process = fork();
    if (process < 0) return nullptr;
    if (process == 0) run(ends[1]);
    close(ends[1]);
    char digits[16] = {};
    const ssize_t count = read(ends[0], digits, sizeof digits - 1);  // once it is ready
    close(ends[0]);
    std::unique_ptr<XServer> server(new XServer(process));
    if (count <= 0) return nullptr;
    setenv("DISPLAY", fmt::format(":{}", std::atoi(digits)).c_str(), 1);
    return server;
  }

  ~XServer() {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
  }
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

 private:
  /// In the child. The server ends with a test that is killed, and holds none of its streams open.
  [[noreturn]] static void run(int toEnd) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    const int nothing = open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, stream);
    execlp("Xvfb", "Xvfb", "-displayfd", fmt::to_string(toEnd).c_str(), "-screen", "0", "800x600x24",
           "-nolisten", "tcp", "-noreset", nullptr);
    _exit(1);
  }

  explicit XServer(pid_t process) : process_(process) {}

  pid_t process_;
};

}  // namespace weft::test
