#pragma once

#include <vector>

namespace weft {

/// Where EGL may have a context without a window.
struct EglPlace {
  enum class Kind {
    Card,  ///< a device
    /// Mesa's platform of that name, which picks a card that Mesa has a driver for, or none
    Surfaceless,
    SoftwareDevice,  ///< Mesa's renderer without a card, as a device
  };

  Kind kind;
  void* device = nullptr;  ///< EGLDeviceEXT of a device
};

/// What was found, in the order in which to try it; each kind keeps its own.
///
/// Cards come first: beside one that another vendor drives, such as NVIDIA's, the surfaceless
/// platform gives a context in software. `softwareOnly`: no cards.
std::vector<EglPlace> inOrderOfTrying(std::vector<EglPlace> found, bool softwareOnly);

}  // namespace weft
