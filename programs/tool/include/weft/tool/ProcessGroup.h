#pragma once

namespace weft {

/// The processes that `mpirun` started together: this program alone where it did not, or where Weft
/// was built without MPI. Make one at the start of main(), and use it from one thread.
class ProcessGroup {
 public:
  ProcessGroup();
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;
  ~ProcessGroup();

  /// Which process this is: 0 .. size() - 1. The first one writes what all have made.
  int rank() const { return rank_; }
  int size() const { return size_; }

  /// Waits for all processes to say how they fared; whether all fared well.
  bool allSucceeded(bool success) const;

 private:
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace weft
