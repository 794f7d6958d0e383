// Artifacts loaded and released while the exhibit runs, from packs in a folder.

#include "app/show/live_exhibit.h"
#include "tests/show/comings.h"

namespace frustumscreen::synthetic {
namespace {

using std::chrono::milliseconds;

TEST_F(ArtifactShowTest, LoadsTheFirstArtifactAtOnceAndThenItsNeighbours) {
    start(5, false);
    EXPECT_EQ(show->artifacts()[0], exhibit::ArtifactState::Ready);
    EXPECT_EQ(show->state({}).loaded, 1U);
    await(1);
    await(4);
    EXPECT_EQ(show->artifacts()[2], exhibit::ArtifactState::Away); // not requested yet
    EXPECT_EQ(show->artifacts()[3], exhibit::ArtifactState::Away);
    EXPECT_EQ(show->state({}).loaded, 3U);
    rest();
    EXPECT_TRUE(shown_blue());
}

TEST_F(ArtifactShowTest, ShowsAPlaceholderUntilTheArtifactIsLoadedAndFadesItIn) {
    start(5, false);
    rest(); // until the first has faded in
    const std::array<settings::Command, 2> twice{settings::Command::NextArtifact,
                                                 settings::Command::NextArtifact};
    step(twice); // to the third, which was not loaded ahead
    bool stood_in = false;
    double last = 0.0;
    while (true) {
        const bool was_ready = show->artifacts()[2] == exhibit::ArtifactState::Ready;
        const exhibit::Presentation presentation = step();
        stood_in = stood_in || (presentation.placeholder && presentation.placeholder->artifact == 2);
        if (!was_ready) {
            EXPECT_TRUE(presentation.artifact != 2 || presentation.brightness == 0.0);
        } else if (presentation.artifact == 2) {
            EXPECT_LE(presentation.brightness - last, 0.25);
            last = presentation.brightness;
        }
        if (last >= 1.0 && !presentation.placeholder) {
            break;
        }
        std::this_thread::sleep_for(milliseconds(1));
    }
    EXPECT_TRUE(stood_in);
    EXPECT_TRUE(shown_blue());
}

TEST_F(ArtifactShowTest, EachArtifactShowsItsOwnPicture) {
    start(5, true);
    std::vector<int> blues;
    for (int k = 0; k < 5; ++k) {
        rest();
        blues.push_back(shown_blue().value_or(-1));
        step(next);
    }
    for (std::size_t k = 1; k < blues.size(); ++k) {
        EXPECT_GT(blues[k], blues[k - 1] + 5) << k;
    }
    rest();
    EXPECT_EQ(show->state({}).loaded, 5U); // all fit
}

TEST_F(ArtifactShowTest, LeavesOutPacksThatAreDamagedOrRemovedAfterTheStart) {
    start(4, false);
    files.damage(1);
    std::filesystem::remove(files.files()[3]);
    await(1);
    await(3);
    EXPECT_EQ(show->artifacts()[1], exhibit::ArtifactState::Unusable);
    EXPECT_EQ(show->artifacts()[3], exhibit::ArtifactState::Unusable);
    ASSERT_EQ(show->state({}).left_out->size(), 2U);
    EXPECT_EQ(show->state({}).left_out->front().pack, files.files()[1].string());
    EXPECT_NE(show->state({}).left_out->front().reason.find("damaged"), std::string::npos)
        << show->state({}).left_out->front().reason;
    step(next); // skips it
    await(2);
    rest();
    EXPECT_EQ(step().artifact, 2U);
    EXPECT_EQ(step().lamps & 3U, 3U); // there is still another one
}

TEST_F(ArtifactShowTest, RejectsAPackThatIsReplacedAfterTheStart) {
    start(3, false);
    pack::Pack other = numbered_pack(1);
    other.title = "Another";
    static_cast<void>(write_file(files.files()[1], pack::write_pack(other).value()));
    await(2);
    await(1);
    EXPECT_EQ(show->artifacts()[1], exhibit::ArtifactState::Unusable);
}

TEST_F(ArtifactShowTest, KeepsTheFirstArtifactIfAllOthersAreUnusable) {
    start(3, false);
    std::filesystem::remove(files.files()[1]);
    std::filesystem::remove(files.files()[2]);
    step(next);
    await(1);
    await(2);
    rest();
    const exhibit::Presentation presentation = step(next);
    EXPECT_EQ(presentation.artifact, 0U);
    EXPECT_EQ(presentation.brightness, 1.0);
    EXPECT_EQ(presentation.lamps & 3U, 0U);
}

TEST_F(ArtifactShowTest, UsesThePlannedGpuMemoryAfterTwentySwitches) {
    start(5, true);
    rest();
    const std::uint64_t before = show->use().gpu_bytes;
    for (int k = 0; k < 20; ++k) {
        step(next);
        rest();
    }
    EXPECT_EQ(show->use().gpu_bytes, show->use().planned_gpu_bytes);
    EXPECT_GE(show->use().gpu_bytes, before);
}

} // namespace
} // namespace frustumscreen::synthetic
