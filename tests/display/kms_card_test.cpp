#include "tests/display/fake_desk.h"

namespace frustumscreen {
namespace {

class KmsCardTest : public Desk {};

TEST_F(KmsCardTest, SeesWhatIsConnected) {
    const Result<KmsCard> card = KmsCard::open(card_path, {});
    ASSERT_TRUE(card) << card.error().message;
    EXPECT_TRUE(card->is_atomic());
    const CardSeen seen = card->look(true);
    ASSERT_EQ(seen.connectors.size(), 2U);
    EXPECT_EQ(seen.connectors[0].name, "HDMI-A-1");
    EXPECT_EQ(seen.connectors[0].plugged, Plugged::Yes);
    EXPECT_EQ(seen.connectors[0].modes.size(), 3U);
}

} // namespace
} // namespace frustumscreen
