// The section states: written, read back, and refused; without it a pack is the same to the byte.
#include "app/pack/pack_file.h"
#include "app/pack/pack_states.h"
#include "app/pack/pack_torches.h"
#include "tests/base/told.h"
#include "tests/pack/world_samples.h"

#include <gtest/gtest.h>

#include <functional>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

std::vector<PackState> three_states() {
    return {{.name = "found", .titles = {{"de", "Fundzustand"}, {"en", "As found"}}, .hidden = {0, 2}},
            {.name = "open", .titles = {{"en", "Open"}}, .behaviour = 1},
            {.name = "today", .titles = {{"en", "Today"}}}};
}

std::string refused_states(const std::function<void(std::vector<PackState>&)>& alter) {
    Pack pack = samples::pack_with_world();
    std::vector<PackState> states = three_states();
    alter(states);
    const Result<void> put = put_states(pack, states);
    return put ? std::string() : test::told(put.error());
}

} // namespace

TEST(States, a_pack_written_and_read_has_the_same_states) {
    Pack pack = samples::pack_with_world();
    const Result<void> put = put_states(pack, three_states());
    ASSERT_TRUE(put) << put.error().message;
    const Result<VerifiedPack> read = verify_pack(samples::bytes_of(pack));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(states_of(**read).value(), three_states());
    EXPECT_TRUE(check_world(**read));
}

TEST(States, rewriting_a_pack_with_states_gives_the_same_bytes) {
    Pack pack = samples::pack_with_world();
    ASSERT_TRUE(put_states(pack, three_states()));
    // A pack that is read has the parts in the order of its manifest's sections, and no longer in that of the calls which put them.
    const Result<VerifiedPack> made = verify_pack(samples::bytes_of(pack));
    ASSERT_TRUE(made) << made.error().message;
    const Bytes bytes = samples::bytes_of(**made);
    const Result<VerifiedPack> read = verify_pack(bytes);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(samples::bytes_of(**read), bytes);
    EXPECT_EQ(states_of(**read).value(), three_states());
    EXPECT_EQ((*read)->sections, (*made)->sections);
}

TEST(States, empty_states_do_not_change_the_bytes) {
    const Pack before = samples::pack_with_world();
    Pack after = before;
    ASSERT_TRUE(put_states(after, {}));
    EXPECT_EQ(samples::bytes_of(after), samples::bytes_of(before));
    EXPECT_TRUE(states_of(after).value().empty());
}

TEST(States, reports_invalid_states_in_one_line) {
    EXPECT_EQ(refused_states([](std::vector<PackState>&) {}), "");
    const auto told = [](const std::function<void(std::vector<PackState>&)>& alter,
                         std::initializer_list<std::string_view> parts) {
        const std::string message = refused_states(alter);
        EXPECT_TRUE(samples::is_one_line(message)) << message;
        EXPECT_TRUE(test::tells(message, parts)) << message;
    };
    told([](auto& states) { states.assign(6, states[2]); }, {"[state_section.count]", "6", "5"});
    told([](auto& states) { states[1].name = states[0].name; }, {"[state_section.name]", "found"});
    told([](auto& states) { states[1].name.clear(); }, {"[state_section.name]"});
    told([](auto& states) { states[1].titles.clear(); }, {"[state_section.no_title]", "open"});
    told([](auto& states) { states[0].hidden = {0, 3}; }, {"[state_section.index]", "cell 3"});
    told([](auto& states) { states[0].hidden = {2, 0}; }, {"[state_section.hidden]", "found"});
    told([](auto& states) { states[1].behaviour = 3; }, {"[state_section.index]", "behaviour 3"});
    told([](auto& states) { states[1].layer = 0; }, {"[state_section.index]", "layer 0"});
}

TEST(States, reports_an_altered_section) {
    Pack pack = samples::pack_with_world();
    ASSERT_TRUE(put_states(pack, three_states()));
    const auto told = [&](const std::string& from, const std::string& to, std::string_view word) {
        Pack altered = pack;
        std::string& data = altered.sections.back().data;
        ASSERT_NE(data.find(from), std::string::npos) << data;
        data.replace(data.find(from), from.size(), to);
        const Result<std::vector<PackState>> read = states_of(altered);
        ASSERT_FALSE(read) << to;
        EXPECT_NE(read.error().message.find(word), std::string::npos) << read.error().message;
    };
    told("\"behaviour\":1", "\"behaviour\":-1", "behaviour");
    told("\"behaviour\":1", "\"behaviour\":1,\"more\":2", "more");
    told("\"layer\":null", "\"layer\":4", "layer");
    told("{\"cell\":2}", "{\"cell\":256}", "cell");
    pack.sections.back().parts = {"states/0.bin"};
    const Result<std::vector<PackState>> parts = states_of(pack);
    ASSERT_FALSE(parts);
    EXPECT_EQ(parts.error().id.view(), "state_section.parts");
}
