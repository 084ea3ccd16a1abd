#include "EglPlace.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

using Kind = EglPlace::Kind;

std::vector<Kind> kindsOf(const std::vector<EglPlace>& places) {
  std::vector<Kind> kinds;
  for (const EglPlace& place : places) kinds.push_back(place.kind);
  return kinds;
}

TEST(EglPlace, ACardIsTriedBeforeMesasSurfacelessPlatformAndThatBeforeSoftware) {
  const std::vector<EglPlace> places =
      inOrderOfTrying({{Kind::Surfaceless}, {Kind::SoftwareDevice}, {Kind::Card}}, false);
  EXPECT_EQ(kindsOf(places), (std::vector{Kind::Card, Kind::Surfaceless, Kind::SoftwareDevice}));
}

TEST(EglPlace, CardsAreTriedInTheOrderOfEGL) {
  int first = 0, second = 0;
  const std::vector<EglPlace> places =
      inOrderOfTrying({{Kind::Surfaceless}, {Kind::Card, &first}, {Kind::Card, &second}}, false);
  ASSERT_EQ(kindsOf(places), (std::vector{Kind::Card, Kind::Card, Kind::Surfaceless}));
  EXPECT_EQ(places[0].device, &first);
  EXPECT_EQ(places[1].device, &second);
}

TEST(EglPlace, WhoAsksForSoftwareGetsNoCard) {
  const std::vector<EglPlace> found{{Kind::Card}, {Kind::SoftwareDevice}, {Kind::Card}, {Kind::Surfaceless}};
  EXPECT_EQ(kindsOf(inOrderOfTrying(found, true)), (std::vector{Kind::Surfaceless, Kind::SoftwareDevice}));
  EXPECT_TRUE(inOrderOfTrying({{Kind::Card}}, true).empty());
}

TEST(EglPlace, NothingFoundIsNothingToTry) {
  EXPECT_TRUE(inOrderOfTrying({}, false).empty());
}

}  // namespace
}  // namespace weft
