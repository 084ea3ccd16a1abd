#include "weft/chunks/State.h"

#include <array>
#include <random>
#include <vector>

#include "GlSnapshot.h"
#include "GlTest.h"
#include "TestSupport.h"
#include "weft/chunks/BlendChunk.h"
#include "weft/chunks/CubeTextureChunk.h"
#include "weft/chunks/DepthChunk.h"
#include "weft/chunks/PolygonOffsetChunk.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/RasterChunk.h"
#include "weft/chunks/SamplerChunk.h"
#include "weft/chunks/StorageBlockChunk.h"
#include "weft/chunks/TextureChunk.h"
#include "weft/chunks/UniformBlockChunk.h"

namespace weft {
namespace {

using test::GlSnapshot;
using test::takeGlSnapshot;
using ChunkList = std::vector<std::shared_ptr<const Chunk>>;

ChunkList textures() {
  const auto floats = [](int layers) {
    return std::make_shared<const FloatImage>(4, 4, std::vector<std::string>{"R", "G"}, layers);
  };
  const auto bytes = std::make_shared<const Image>(3, 5, 1);
  const auto shaped = [](TextureShape shape) { return TextureOptions{.shape = shape}; };
  return {
      std::make_shared<TextureChunk>(floats(1)),
      std::make_shared<TextureChunk>(floats(1), TextureOptions{.shape = TextureShape::TwoDimensional,
                                                               .filter = TextureFilter::Mipmapped,
                                                               .wrap = TextureWrap::Repeat}),
      std::make_shared<TextureChunk>(floats(3), shaped(TextureShape::Array)),
      std::make_shared<TextureChunk>(floats(1), shaped(TextureShape::Rectangle)),
      std::make_shared<TextureChunk>(floats(2), shaped(TextureShape::ThreeDimensional)),
      std::make_shared<CubeTextureChunk>(floats(6)),
      std::make_shared<TextureChunk>(bytes),
      std::make_shared<TextureChunk>(bytes, TextureOptions{.wrap = TextureWrap::Mirror, .srgb = true}),
      std::make_shared<TextureChunk>(std::make_shared<const FloatImage>()),
      std::make_shared<TextureChunk>(std::shared_ptr<const Image>(), shaped(TextureShape::Rectangle)),
  };
}

template <class BlockKind>
ChunkList blocks() {
  ChunkList chunks;
  for (const std::size_t size : {16u, 16u, 64u, 0u})
    chunks.push_back(std::make_shared<BlockKind>(std::vector<std::byte>(size, std::byte(chunks.size()))));
  return chunks;
}

ChunkList programs() {
  const auto lambert = [](std::vector<std::pair<std::string, std::string>> defines) {
    return std::make_shared<ProgramChunk>(ShaderSource{"mesh.vert", "lambert.frag", std::move(defines)});
  };
  return {lambert({}), lambert({{"BASE_COLOR_TEXTURE", ""}}), lambert({{"albedo", "broken("}})};
}

ChunkList depths() {
  ChunkList chunks;
  for (const bool test : {false, true})
    for (const bool write : {false, true}) chunks.push_back(std::make_shared<DepthChunk>(test, write));
  return chunks;
}

ChunkList rasters() {
  ChunkList chunks;
  for (const Culling culling : {Culling::Back, Culling::None, Culling::Front})
    chunks.push_back(std::make_shared<RasterChunk>(culling));
  return chunks;
}

ChunkList samplers() {
  ChunkList chunks;
  for (const TextureWrap wrap : {TextureWrap::Repeat, TextureWrap::Clamp, TextureWrap::Mirror})
    chunks.push_back(std::make_shared<SamplerChunk>(Sampling{.wrap = wrap}));
  return chunks;
}

/// Several of every kind of chunk.
std::vector<ChunkList> allKinds() {
  return {
      programs(),
      {std::make_shared<BlendChunk>(), std::make_shared<BlendChunk>(BlendKind::Tint)},
      depths(),
      rasters(),
      {std::make_shared<PolygonOffsetChunk>(-1.0f, -2.0f), std::make_shared<PolygonOffsetChunk>(3.0f, 0.0f)},
      textures(),
      samplers(),
      blocks<UniformBlockChunk>(),
      blocks<StorageBlockChunk>()};
}

unsigned placesOf(Slot kind) {
  if (kind == TextureSlot) return SamplerSlot - TextureSlot;
  if (kind == SamplerSlot) return UniformSlot - SamplerSlot;
  if (kind == UniformSlot) return StorageSlot - UniformSlot;
  return kind == StorageSlot ? SlotCount - StorageSlot : 1;
}

class StateTest : public test::GlTest {
 protected:
  GlSnapshot activated(const Chunk& chunk, unsigned slot) {
    chunk.activate(context(), slot);
    GlSnapshot snapshot = takeGlSnapshot();
    chunk.deactivate(context(), slot);
    return snapshot;
  }

  void expectPairRestores(const Chunk& a, const Chunk& b, unsigned slot) {
    const GlSnapshot before = takeGlSnapshot();
    const GlSnapshot alone = activated(b, slot);
    EXPECT_EQ(test::difference(takeGlSnapshot(), before), "");

    a.activate(context(), slot);
    b.changeFrom(context(), a, slot);
    EXPECT_EQ(test::difference(takeGlSnapshot(), alone), "") << "a change ends where an activation does";
    b.deactivate(context(), slot);
    EXPECT_EQ(test::difference(takeGlSnapshot(), before), "");
    (void)context().takeErrors();  // of the program that is broken on purpose
  }
};

TEST_F(StateTest, EveryPairOfChunksRestoresTheSnapshot) {
  for (const ChunkList& chunks : allKinds()) {
    const Slot kind = chunks.front()->kind();
    for (const unsigned slot : {unsigned(kind), kind + placesOf(kind) - 1})
      for (std::size_t a = 0; a < chunks.size(); ++a)
        for (std::size_t b = 0; b < chunks.size(); ++b) {
          SCOPED_TRACE("slot " + std::to_string(slot) + ", " + std::to_string(a) + " to " +
                       std::to_string(b));
          expectPairRestores(*chunks[a], *chunks[b], slot);
        }
  }
}

TEST_F(StateTest, ChunksThatHaveSomethingToSetDoSet) {
  const GlSnapshot before = takeGlSnapshot();
  for (const ChunkList& chunks : allKinds()) {
    EXPECT_NE(test::difference(activated(*chunks.front(), chunks.front()->kind()), before), "")
        << chunks.front()->kind();
    (void)context().takeErrors();
  }
}

TEST_F(StateTest, ChangingBetweenRandomStatesEndsWhereActivatingDoes) {
  const std::vector<ChunkList> kinds = allKinds();
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const auto randomState = [&] {
    State state;
    for (int i = 0; i < 12; ++i) {
      const ChunkList& chunks = kinds[below(kinds.size())];
      const Slot kind = chunks.front()->kind();
      const auto place = static_cast<unsigned>(below(std::min(placesOf(kind), 4u)));
      state.set(kind + place, below(4) == 0 ? nullptr : chunks[below(chunks.size())]);
    }
    return state;
  };

  const GlSnapshot before = takeGlSnapshot();
  State previous;
  for (int round = 0; round < 40; ++round) {
    const State next = randomState();
    previous.deactivate(context());
    EXPECT_EQ(test::difference(takeGlSnapshot(), before), "");
    next.activate(context());
    const GlSnapshot alone = takeGlSnapshot();
    next.deactivate(context());

    previous.activate(context());
    next.changeFrom(context(), previous);
    EXPECT_EQ(test::difference(takeGlSnapshot(), alone), "") << "round " << round;
    previous = next;
  }
  previous.deactivate(context());
  EXPECT_EQ(test::difference(takeGlSnapshot(), before), "");
  (void)context().takeErrors();
}

/// Notes what is called on it.
class NotingChunk : public Chunk {
 public:
  explicit NotingChunk(std::vector<std::string>& calls) : calls_(calls) {}

  Slot kind() const override { return TextureSlot; }
  void activate(GLContext&, unsigned slot) const override { note("activate", slot); }
  void changeFrom(GLContext&, const Chunk&, unsigned slot) const override { note("change", slot); }
  void deactivate(GLContext&, unsigned slot) const override { note("deactivate", slot); }

 private:
  void note(const char* call, unsigned slot) const {
    calls_.push_back(call + std::string(" ") + std::to_string(slot - TextureSlot));
  }

  std::vector<std::string>& calls_;
};

TEST_F(StateTest, VisitsOnlySlotsThatDiffer) {
  std::vector<std::string> calls;
  const auto chunk = [&] { return std::make_shared<NotingChunk>(calls); };
  State before, after;
  const auto shared = chunk();
  before.set(textureSlot(3), shared);
  after.set(textureSlot(3), shared);
  before.set(textureSlot(5), chunk());
  after.set(textureSlot(5), chunk());
  before.set(textureSlot(7), chunk());
  after.set(textureSlot(31), chunk());
  after.set(textureSlot(9), chunk());
  after.set(textureSlot(9), nullptr);
  after.changeFrom(context(), before);
  EXPECT_EQ(calls, (std::vector<std::string>{"change 5", "deactivate 7", "activate 31"}));
}

TEST_F(StateTest, NothingTouchesGLBeforeTheFirstActivation) {
  window.reset();  // no context is current: a GL call would crash
  for (const ChunkList& chunks : allKinds()) {
    State state;
    state.set(chunks.front()->kind(), chunks.front());
    EXPECT_EQ(state.at(chunks.front()->kind()), chunks.front().get());
  }
}

TEST_F(StateTest, EveryChunkServesTwoContextsAndOutlivesBoth) {
  std::vector<ChunkList> kinds = allKinds();
  auto other = test::valueOf(HeadlessWindow::create(true));
  const auto activateAll = [&](HeadlessWindow& each) {
    each.makeCurrent();
    for (const ChunkList& chunks : kinds)
      for (const auto& chunk : chunks) {
        chunk->activate(each.context(), chunk->kind());
        chunk->deactivate(each.context(), chunk->kind());
      }
    (void)each.context().takeErrors();  // of the program that is broken on purpose
  };
  activateAll(*window);
  activateAll(*other);
  activateAll(*window);
  other.reset();
  kinds.front().clear();  // the objects of these stay in the first context until its next frame
  activateAll(*window);
  window.reset();
  kinds.clear();  // no context is current: a GL call would crash
}

TEST(StateDeathTest, AChunkGoesOnlyIntoASlotOfItsKind) {
  State state;
  EXPECT_DEATH(state.set(ProgramSlot, std::make_shared<DepthChunk>()), "slot of its kind");
  EXPECT_DEATH(state.set(SlotCount, nullptr), "no such slot");
}

}  // namespace
}  // namespace weft
