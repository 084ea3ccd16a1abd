#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

namespace weft::test {

/// While it lives, a test that root runs may read and write only what everyone may.
class UnprivilegedUser {
 public:
  UnprivilegedUser() { become(kNobody); }
  ~UnprivilegedUser() { become(0); }
  UnprivilegedUser(const UnprivilegedUser&) = delete;
  UnprivilegedUser& operator=(const UnprivilegedUser&) = delete;

 private:
  static constexpr uid_t kNobody = 65534;

  static void become(uid_t user) {
    if (getuid() != 0) return;
    EXPECT_EQ(seteuid(user), 0);
  }
};

}  // namespace weft::test
