#include <gtest/gtest.h>

#include <clocale>

// As a program with a window does: numbers in files must not depend on what the user's locale says.
int main(int argc, char** argv) {
  std::setlocale(LC_ALL, "");
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
