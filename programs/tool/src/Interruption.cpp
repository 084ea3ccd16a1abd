#include "Interruption.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <system_error>
#include <thread>

#include "weft/core/AtomicFile.h"

namespace weft {
namespace {

bool isIgnored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

sigset_t endingSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU, SIGUSR1, SIGUSR2})
    if (!isIgnored(signal)) sigaddset(&signals, signal);
  return signals;
}

// A thread that waits for the signal may lock and allocate, which a signal handler may not.
[[noreturn]] void waitForEnd(sigset_t signals) {
  int number = 0;
  sigwait(&signals, &number);
  AtomicFile::removeAllPending();
  // Whoever waits for the program shall see that the signal has ended it.
  std::signal(number, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  raise(number);
  _exit(128 + number);
}

}  // namespace

void endCleanlyWhenInterrupted() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  const sigset_t signals = endingSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // threads that are started later inherit it
  try {
    std::thread(waitForEnd, signals).detach();
  } catch (const std::system_error&) {  // no thread to be had: a later run removes what stays
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  }
}

}  // namespace weft
