#include "ProgramRun.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "TestSupport.h"
#include "TextFile.h"

namespace weft::test {

ProgramRun runProgram(const std::string& name, const std::vector<std::string>& arguments) {
  const std::string program = (programFolder() / name).string();
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("weft-run-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string out = folder / "out";
  const std::string err = folder / "err";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t process = 0;
  int status = 0;
  ProgramRun run;
  if (posix_spawn(&process, program.c_str(), &actions, nullptr, argv.data(), environ) == 0 &&
      waitpid(process, &status, 0) == process) {
    run.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    run.out = readText(out);
    run.err = readText(err);
  } else {
    ADD_FAILURE() << program << " cannot be run";
  }
  posix_spawn_file_actions_destroy(&actions);
  std::filesystem::remove_all(folder);
  return run;
}

}  // namespace weft::test
