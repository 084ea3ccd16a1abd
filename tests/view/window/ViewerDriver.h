#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "XServer.h"
#include "weft/core/Image.h"

struct _XDisplay;

namespace weft::test {

/// A running weft-view in a display in memory, driven as people do: by keys, the mouse and files
/// that are dropped on it. What does not happen within 30 s fails the test.
class ViewerDriver {
 public:
  /// Null, with the reason, without Xvfb.
  static std::unique_ptr<ViewerDriver> start(const std::vector<std::string>& arguments,
                                             const std::filesystem::path& folder);
  ~ViewerDriver();
  ViewerDriver(const ViewerDriver&) = delete;
  ViewerDriver& operator=(const ViewerDriver&) = delete;

  /// Until the window's title begins so, which names the file that is shown.
  bool waitForTitle(const std::string& beginning);
  /// A key by X's name for it, "F1", with another held down or none.
  void press(const std::string& key, const std::string& held = {});
  /// Moves the mouse to a place of the window, then by so much with a button held down.
  void drag(unsigned button, int x, int y, int right, int down);
  void drop(const std::filesystem::path& file);
  /// What S leaves.
  Image screenshot();
  /// Waits for the end of the program; its exit code.
  int exitCode();

 private:
  ViewerDriver(std::unique_ptr<XServer> server, const std::vector<std::string>& arguments,
               std::filesystem::path folder);
  unsigned long findWindow() const;
  std::string title() const;
  void sendDnd(const char* kind, const std::vector<long>& data);
  bool answerSelection(const std::string& text);
  void key(const std::string& name, bool down);

  std::unique_ptr<XServer> server_;
  std::filesystem::path folder_;
  _XDisplay* display_;
  pid_t process_;
  unsigned long window_ = 0;
  unsigned long source_ = 0;  ///< of what is dropped
  int screenshots_ = 0;
};

}  // namespace weft::test
