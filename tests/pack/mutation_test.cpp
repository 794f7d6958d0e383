// Seeded mutants of a pack: each is refused in one line, or is a pack that a renderer can use without checks.
#include "tests/pack/samples.h"

#include <set>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FRUSTUMSCREEN_FEWER_MUTANTS 3
#else
#define FRUSTUMSCREEN_FEWER_MUTANTS 1
#endif

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

constexpr int all_mutants = 3000 / FRUSTUMSCREEN_FEWER_MUTANTS;

/// Applies one of the alterations by which fuzzers find most faults.
void mutate(Bytes& bytes, std::mt19937& random) {
    if (bytes.empty()) {
        return;
    }
    const std::size_t at = random() % bytes.size();
    const std::size_t count = std::min<std::size_t>(1 + random() % 16, bytes.size() - at);
    static constexpr std::array<std::uint8_t, 6> interesting{0x00, 0xFF, 0x7F, 0x80, 0x01, 0x20};
    const auto place = [&](std::size_t k) { return bytes.begin() + static_cast<std::ptrdiff_t>(k); };
    switch (random() % 6) {
    case 0:
        bytes[at] ^= static_cast<std::byte>(1U << (random() % 8));
        break;
    case 1:
        std::fill(place(at), place(at + count), std::byte{interesting[random() % interesting.size()]});
        break;
    case 2:
        bytes.erase(place(at), place(at + count));
        break;
    case 3:
        bytes.insert(place(at), count, static_cast<std::byte>(random()));
        break;
    case 4: {
        const Bytes run(place(at), place(at + count));
        std::copy(run.begin(), run.end(), place(random() % (bytes.size() - count + 1)));
        break;
    }
    default:
        bytes.resize(at);
    }
}

/// Checks independently what the renderer relies on.
void expect_usable(const Pack& pack) {
    ASSERT_FALSE(pack.levels.empty());
    ASSERT_LT(pack.default_level, pack.levels.size());
    const Placement placement = place(pack, geometry::make_frustum({}));
    ASSERT_TRUE(placement.metres_per_box > 0.05 && placement.metres_per_box < 0.3)
        << placement.metres_per_box;
    for (const PackLevel& level : pack.levels) {
        ASSERT_LT(level.texture, pack.textures.size());
        const image::Image8& texture = pack.textures[level.texture];
        ASSERT_EQ(texture.texels.size(),
                  static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height));
        ASSERT_FALSE(texture.texels.empty());
        const std::set<std::uint32_t> used(level.indices.begin(), level.indices.end());
        ASSERT_LT(*used.rbegin(), level.vertices.size());
        std::size_t next = 0;
        for (const PackCluster& cluster : level.clusters) {
            ASSERT_EQ(cluster.first_index, next);
            next += cluster.index_count;
            ASSERT_EQ(next % 3, 0U);
            ASSERT_TRUE(cluster.radius >= 0.0F && cluster.radius < INFINITY);
        }
        ASSERT_EQ(next, level.indices.size());
    }
    ASSERT_TRUE(write_pack(pack)) << "what was read can be written";
}

struct Count {
    int mutants = 0;
    int refused = 0;
};

void judge(const Bytes& bytes, Count& count) {
    ++count.mutants;
    const Result<VerifiedPack> pack = verify_pack(bytes);
    if (!pack) {
        ++count.refused;
        ASSERT_TRUE(samples::is_one_line(pack.error().message)) << pack.error().message;
        return;
    }
    expect_usable(**pack);
}

} // namespace

TEST(Mutants, file_mutants_are_refused_or_usable) {
    const Bytes bytes = samples::bytes_of(samples::full_pack());
    std::mt19937 random(101);
    Count count;
    while (count.mutants < all_mutants && !HasFatalFailure()) {
        Bytes mutant = bytes;
        for (unsigned k = 0; k < 1 + random() % 3; ++k) {
            mutate(mutant, random);
        }
        judge(mutant, count);
    }
    EXPECT_GT(count.refused, count.mutants * 3 / 4);
}

TEST(Mutants, part_mutants_with_valid_hashes_are_refused_or_usable) {
    const samples::Entries entries = samples::take_apart(samples::bytes_of(samples::full_pack()));
    std::mt19937 random(102);
    Count count;
    while (count.mutants < all_mutants && !HasFatalFailure()) {
        samples::Entries mutant = entries;
        mutate(mutant.parts[random() % mutant.parts.size()].second, random);
        samples::right_hashes(mutant);
        judge(samples::put_together(mutant), count);
    }
    EXPECT_GT(count.refused, count.mutants / 4);
    EXPECT_LT(count.refused, count.mutants) << "some mutants reach the last check";
}

TEST(Mutants, manifest_mutants_are_refused_or_usable) {
    const samples::Entries entries = samples::take_apart(samples::bytes_of(samples::full_pack()));
    const std::string manifest = entries.manifest.dump();
    const auto manifest_bytes = as_bytes(manifest);
    std::mt19937 random(103);
    Count count;
    while (count.mutants < all_mutants * 2 / 3 && !HasFatalFailure()) {
        Bytes mutant(manifest_bytes.begin(), manifest_bytes.end());
        mutate(mutant, random);
        judge(samples::put_together(std::string(as_text(mutant)), entries.parts), count);
    }
    EXPECT_LT(count.refused, count.mutants);
}
