#include "app/watch/ladder_memory.h"

#include <gtest/gtest.h>

#include <random>

namespace frustumscreen::watch {
namespace {

using std::chrono::hours;
using std::chrono::minutes;

KeptMemory some_memory(std::uint64_t writes) {
    KeptMemory kept{writes, number_of_boot("0a1b"), minutes(7), {}};
    LadderMemory& memory = kept.memory;
    memory.awake = hours(1234);
    memory.mode = Mode::BuiltIn;
    memory.climb = 5;
    memory.returns = 2;
    memory.tried = 21;
    memory.given_up = 32;
    memory.cause = Cause::KeepsEnding;
    memory.latest = Step::BuiltIn;
    memory.latest_at = hours(1233);
    memory.helped[2] = Step::Reboot;
    memory.reboots[0] = hours(1230);
    memory.reboots[1] = hours(1200);
    return kept;
}

TEST(LadderMemory, RoundTrip) {
    const KeptMemory kept = some_memory(9);
    const std::string slot = slot_of(kept);
    EXPECT_EQ(slot.size(), slot_bytes);
    EXPECT_EQ(read_slot(slot), kept);
    EXPECT_EQ(read_slot(slot_of({})), KeptMemory{});
}

TEST(LadderMemory, ReadsTheLaterSlot) {
    EXPECT_EQ(read_slots(slot_of(some_memory(8)) + slot_of(some_memory(7)))->writes, 8U);
    EXPECT_EQ(read_slots(slot_of(some_memory(8)) + slot_of(some_memory(9)))->writes, 9U);
    EXPECT_FALSE(read_slots(""));
    EXPECT_FALSE(read_slots(std::string(2 * slot_bytes, '\0')));
}

TEST(LadderMemory, TornWriteKeepsTheFormerSlot) {
    const std::string former = slot_of(some_memory(8));
    const std::string older = slot_of(some_memory(7));
    const std::string later = slot_of(some_memory(9));
    std::mt19937 chance(1);
    for (std::size_t cut = 0; cut < slot_bytes;
         cut += 3) { // a part of the new bytes was written, in any order of sectors
        std::string torn = older;
        for (std::size_t k = 0; k < slot_bytes; ++k) {
            torn[k] = (chance() & 1U) != 0 && k < cut ? later[k] : k < cut / 2 ? later[k] : older[k];
        }
        const std::optional<KeptMemory> kept = read_slots(former + torn);
        ASSERT_TRUE(kept);
        EXPECT_TRUE(kept->writes == 8 || (kept->writes == 9 && torn == later));
    }
}

TEST(LadderMemory, RejectsAnyChangedByte) {
    const std::string slot = slot_of(some_memory(9));
    const std::size_t end = slot.find_last_not_of(" \n");
    std::mt19937 chance(2);
    for (std::size_t k = 0; k <= end; ++k) {
        std::string changed = slot;
        changed[k] = static_cast<char>(changed[k] ^ static_cast<char>(1 + chance() % 255));
        EXPECT_FALSE(read_slot(changed)) << k;
    }
    EXPECT_FALSE(read_slot(slot.substr(1)));
}

/// A hand-written body, with a valid checksum.
std::string signed_by_hand(const std::string& body) {
    std::uint64_t hash = 14695981039346656037U;
    for (const char each : body) {
        hash = (hash ^ static_cast<unsigned char>(each)) * 1099511628211U;
    }
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
    std::string slot = std::string("frustumscreen-ladder-2 ") + digits.data() + " " + body;
    slot.resize(slot_bytes, ' ');
    slot.back() = '\n';
    return slot;
}

TEST(LadderMemory, RejectsNumbersOutOfRange) {
    const std::string rest = "-1 -1 -1 -1 -1 -1 -1 -1 -1 -1 -1 -1 ";
    EXPECT_TRUE(read_slot(signed_by_hand("1 2 3 1000 0 0 0 0 0 -1 -1 900 " + rest)));
    for (const char* const body :
         {"-1 2 3 1000 0 0 0 0 0 -1 -1 900 ", "1 2 3 1000 5 0 0 0 0 -1 -1 900 ",
          "1 2 3 1000 0 13 0 0 0 -1 -1 900 ", "1 2 3 1000 0 0 9 0 0 -1 -1 900 ",
          "1 2 3 1000 0 0 0 256 0 -1 -1 900 ", "1 2 3 1000 0 0 0 0 64 -1 -1 900 ",
          "1 2 3 1000 0 0 0 0 0 6 -1 900 ", "1 2 3 1000 0 0 0 0 0 -1 8 900 ",
          "1 2 3 1000 0 0 0 0 0 -1 -1 1001 ", "1 2 3 99999999999999999999 0 0 0 0 0 -1 -1 900 ",
          "1 2 3 1000 0 0 0 0 0 -1 900 ", "1 2 3 x 0 0 0 0 0 -1 -1 900 "}) {
        EXPECT_FALSE(read_slot(signed_by_hand(body + rest))) << body;
    }
    EXPECT_FALSE(read_slot(signed_by_hand("1 2 3 1000 0 0 0 0 0 -1 -1 900 " + rest + "5 ")));
    // A reboot in the future, and reboots out of order.
    EXPECT_FALSE(
        read_slot(signed_by_hand("1 2 3 1000 0 0 0 0 0 -1 -1 900 -1 -1 -1 -1 -1 -1 1001 -1 -1 -1 -1 -1 ")));
    EXPECT_FALSE(
        read_slot(signed_by_hand("1 2 3 1000 0 0 0 0 0 -1 -1 900 -1 -1 -1 -1 -1 -1 500 600 -1 -1 -1 -1 ")));
    EXPECT_TRUE(
        read_slot(signed_by_hand("1 2 3 1000 0 0 0 0 0 -1 -1 900 -1 -1 -1 -1 -1 -1 600 500 -1 -1 -1 -1 ")));
}

TEST(LadderMemory, TimeAwakeContinuesByElapsedTimeOnly) {
    const KeptMemory kept = some_memory(1);
    EXPECT_EQ(remembered(kept, kept.boot, minutes(9)).awake, hours(1234) + minutes(2));
    EXPECT_EQ(remembered(kept, kept.boot + 1, minutes(9)).awake, hours(1234) + minutes(9));
    EXPECT_EQ(remembered(kept, kept.boot, minutes(1)).awake, hours(1234) + minutes(1));
}

} // namespace
} // namespace frustumscreen::watch
