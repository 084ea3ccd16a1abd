#include "ViewerDriver.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "TestSupport.h"
#include "weft/io/ImageFile.h"

// Last: their macros are called None, True and the like.
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>

namespace weft::test {
namespace {

using Clock = std::chrono::steady_clock;

bool waitUntil(const std::function<bool()>& isSo) {
  for (const auto end = Clock::now() + std::chrono::seconds(30); Clock::now() < end;) {
    if (isSo()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

pid_t startProgram(std::vector<std::string> arguments, const std::filesystem::path& folder) {
  arguments.insert(arguments.begin(), (programFolder() / "weft-view").string());
  std::vector<char*> words;
  for (std::string& word : arguments) words.push_back(word.data());
  words.push_back(nullptr);
  const pid_t process = fork();
  if (process != 0) return process;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (chdir(folder.c_str()) != 0) _exit(126);
  setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1);
  execv(words[0], words.data());
  _exit(127);
}

}  // namespace

std::unique_ptr<ViewerDriver> ViewerDriver::start(const std::vector<std::string>& arguments,
                                                  const std::filesystem::path& folder) {
  auto server = XServer::start();
  if (!server) return nullptr;
  return std::unique_ptr<ViewerDriver>(new ViewerDriver(std::move(server), arguments, folder));
}

ViewerDriver::ViewerDriver(std::unique_ptr<XServer> server, const std::vector<std::string>& arguments,
                           std::filesystem::path folder)
    : server_(std::move(server)),
      folder_(std::move(folder)),
      display_(XOpenDisplay(nullptr)),
      process_(startProgram(arguments, folder_)) {
  if (!waitUntil([&] { return (window_ = findWindow()) != 0; })) ADD_FAILURE() << "no window came up";
  source_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
}

ViewerDriver::~ViewerDriver() {
  if (process_ != 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  XCloseDisplay(display_);
}

// The one that is shown; GLFW has hidden ones.
unsigned long ViewerDriver::findWindow() const {
  Window root = 0, parent = 0, *children = nullptr, found = 0;
  unsigned count = 0;
  if (!XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &children, &count)) return 0;
  for (unsigned i = 0; i < count; ++i) {
    XWindowAttributes attributes;
    if (XGetWindowAttributes(display_, children[i], &attributes) && attributes.map_state == IsViewable)
      found = children[i];
  }
  if (children) XFree(children);
  return found;
}

std::string ViewerDriver::title() const {
  char* name = nullptr;
  if (!XFetchName(display_, window_, &name) || !name) return {};
  const std::string text = name;
  XFree(name);
  return text;
}

bool ViewerDriver::waitForTitle(const std::string& beginning) {
  return waitUntil([&] { return title().starts_with(beginning); });
}

void ViewerDriver::key(const std::string& name, bool down) {
  XTestFakeKeyEvent(display_, XKeysymToKeycode(display_, XStringToKeysym(name.c_str())), down, CurrentTime);
}

void ViewerDriver::press(const std::string& name, const std::string& held) {
  if (!held.empty()) key(held, true);
  key(name, true);
  key(name, false);
  if (!held.empty()) key(held, false);
  XSync(display_, False);
}

void ViewerDriver::drag(unsigned button, int x, int y, int right, int down) {
  XTestFakeMotionEvent(display_, -1, x, y, CurrentTime);
  XTestFakeButtonEvent(display_, button, True, CurrentTime);
  for (int step = 1; step <= 4; ++step)
    XTestFakeMotionEvent(display_, -1, x + right * step / 4, y + down * step / 4, CurrentTime);
  XTestFakeButtonEvent(display_, button, False, CurrentTime);
  XSync(display_, False);
}

void ViewerDriver::sendDnd(const char* kind, const std::vector<long>& data) {
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.display = display_;
  event.xclient.window = window_;
  event.xclient.message_type = XInternAtom(display_, kind, False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(source_);
  for (std::size_t i = 0; i < data.size(); ++i) event.xclient.data.l[i + 1] = data[i];
  XSendEvent(display_, window_, False, NoEventMask, &event);
  XSync(display_, False);
}

/// Gives whoever asks for it what is dropped.
bool ViewerDriver::answerSelection(const std::string& text) {
  XEvent event;
  if (!XCheckTypedEvent(display_, SelectionRequest, &event)) return false;
  const XSelectionRequestEvent& asked = event.xselectionrequest;
  XChangeProperty(display_, asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                  reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  XEvent answer{};
  answer.xselection.type = SelectionNotify;
  answer.xselection.requestor = asked.requestor;
  answer.xselection.selection = asked.selection;
  answer.xselection.target = asked.target;
  answer.xselection.property = asked.property;
  answer.xselection.time = asked.time;
  XSendEvent(display_, asked.requestor, False, NoEventMask, &answer);
  XSync(display_, False);
  return true;
}

// The XDND protocol, version 5, from the side of a file manager.
void ViewerDriver::drop(const std::filesystem::path& file) {
  const auto atom = [&](const char* name) { return static_cast<long>(XInternAtom(display_, name, False)); };
  XSetSelectionOwner(display_, static_cast<Atom>(atom("XdndSelection")), source_, CurrentTime);
  sendDnd("XdndEnter", {5L << 24, atom("text/uri-list")});
  sendDnd("XdndPosition", {0, (400L << 16) | 300, CurrentTime, atom("XdndActionCopy")});
  sendDnd("XdndDrop", {0, CurrentTime});
  const std::string text = "file://" + file.string() + "\r\n";
  EXPECT_TRUE(waitUntil([&] { return answerSelection(text); })) << "nobody takes what is dropped";
}

Image ViewerDriver::screenshot() {
  press("s");
  const auto file = folder_ / fmt::format("weft-view-{:03}.png", ++screenshots_);
  if (!waitUntil([&] { return std::filesystem::exists(file); })) {
    ADD_FAILURE() << file << " does not come";
    return {};
  }
  return valueOf(readImage(file));
}

int ViewerDriver::exitCode() {
  int status = 0;
  if (!waitUntil([&] { return waitpid(process_, &status, WNOHANG) == process_; })) return -1;
  process_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace weft::test
