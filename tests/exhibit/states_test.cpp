// The table of states, compared with one written by hand for this test, and with the page in docs.

#include "app/exhibit/states.h"
#include "app/exhibit/states_page.h"
#include "tests/base/text_of.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace frustumscreen::exhibit {
namespace {

/// The state after each event, in the order of the headings; '.' stays.
constexpr const char* by_hand =
    "                  attract  view     browse   guide    describe degraded fault    staff\n"
    "rest              .        attract  attract  attract  attract  attract  attract  view\n"
    "visitor_comes     view     .        .        .        .        .        .        .\n"
    "chord             staff    staff    staff    staff    staff    staff    staff    view\n"
    "press             view     .        .        .        .        .        .        .\n"
    "nothing_to_show   fault    fault    fault    fault    fault    fault    .        .\n"
    "something_to_show .        .        .        .        .        .        view     .\n"
    "tracker_lost      .        degraded degraded degraded .        .        .        .\n"
    "tracker_back      .        .        .        .        .        view     .        .\n"
    "prop_rests        .        browse   .        browse   .        .        .        .\n"
    "prop_goes_on      .        .        view     .        .        .        .        .\n"
    "artifact_chosen   .        .        view     .        view     .        .        .\n"
    "telling_begins    .        describe describe describe .        describe .        .\n"
    "telling_ends      .        .        .        .        view     .        .        .\n"
    "advice_due        .        guide    .        .        .        .        .        .\n"
    "advice_over       .        .        .        view     .        .        .        .\n";

std::string with_spaces(std::string name) {
    for (char& c : name) {
        c = c == '_' ? ' ' : c;
    }
    return name;
}

TEST(States, TransitionsMatchTheTable) {
    std::istringstream lines(by_hand);
    std::string line;
    std::getline(lines, line);
    std::istringstream heads(line);
    const std::vector<std::string> states{std::istream_iterator<std::string>(heads), {}};
    ASSERT_EQ(states.size(), state_count);
    std::size_t events = 0;
    for (; std::getline(lines, line); ++events) {
        std::istringstream row(line);
        std::string event;
        row >> event;
        ASSERT_LT(events, event_count);
        EXPECT_EQ(note_of(static_cast<Event>(events)).name, with_spaces(event));
        for (std::size_t from = 0; from < state_count; ++from) {
            std::string to;
            row >> to;
            EXPECT_EQ(name_of(static_cast<State>(from)), states[from]);
            EXPECT_EQ(name_of(next(static_cast<State>(from), static_cast<Event>(events))),
                      to == "." ? states[from] : to)
                << states[from] << " " << event;
        }
    }
    EXPECT_EQ(events, event_count);
}

Observed observed(unsigned bits) {
    return {(bits & 1U) != 0, (bits & 2U) != 0, (bits & 4U) != 0, false, (bits & 8U) != 0, (bits & 16U) != 0};
}

/// While nothing changes on the table, states do not alternate.
TEST(States, SettleWhileNothingChanges) {
    for (const StateNote& note : state_notes) {
        for (unsigned bits = 0; bits < 32; ++bits) {
            for (const Event visitor : {Event::Rest, Event::VisitorComes}) {
                const auto step = [&](State state) {
                    const bool staff_goes_on = state == State::Staff;
                    return state_after(staff_goes_on ? state : next(state, visitor), observed(bits));
                };
                State state = note.state;
                for (int k = 0; k < 3; ++k) {
                    state = step(state);
                }
                EXPECT_EQ(step(state), state) << note.name << " " << bits;
                const bool nothing = (bits & 1U) != 0;
                if (visitor == Event::Rest && !nothing && note.state != State::Staff) {
                    EXPECT_EQ(state, State::Attract) << note.name << " " << bits;
                }
                if (nothing && note.state != State::Staff) {
                    EXPECT_EQ(state, State::Fault) << note.name << " " << bits;
                }
            }
        }
    }
}

TEST(States, OnlyFaultAndStaffShowNoArtifact) {
    for (const StateNote& note : state_notes) {
        EXPECT_EQ(note.artifact, note.state != State::Fault && note.state != State::Staff) << note.name;
        EXPECT_TRUE(!note.voice || note.words == Words::Advice || note.words == Words::Narration)
            << note.name;
    }
    EXPECT_FALSE(note_of(State::Attract).voice); // no visitor can hear it
}

TEST(StatesPage, MatchesTheCommittedPage) {
    const std::string committed = text_of(source_dir() + "/docs/states.md");
    EXPECT_EQ(states_page(), committed) << "write it again: frustumscreen states > docs/states.md";
}

/// The committed page, compared with the hand-written table.
TEST(StatesPage, ContainsEveryTransition) {
    const std::string page = text_of(source_dir() + "/docs/states.md");
    std::istringstream lines(by_hand);
    std::size_t rows = 0;
    for (std::string line; std::getline(lines, line); ++rows) {
        std::istringstream cells(line);
        std::string row = "\n|" + std::string(rows == 0 ? " |" : "");
        for (std::string cell; cells >> cell;) {
            row += cell == "." ? "  |" : " " + with_spaces(cell) + " |";
        }
        EXPECT_NE(page.find(row + "\n"), std::string::npos) << row;
    }
    EXPECT_EQ(rows, event_count + 1);
}

/// The picture has the edges of the graph from which it was drawn.
TEST(StatesPage, PictureHasEveryEdgeOfTheGraph) {
    const std::string svg = text_of(source_dir() + "/docs/states.svg");
    std::istringstream graph(states_graph());
    std::size_t edges = 0;
    for (std::string line; std::getline(graph, line);) {
        const std::size_t arrow = line.find(" -> ");
        if (arrow == std::string::npos || line.find("style=invis") != std::string::npos) {
            continue;
        }
        ++edges;
        const std::string from = line.substr(2, arrow - 2);
        const std::string to = line.substr(arrow + 4, line.find(' ', arrow + 4) - arrow - 4);
        EXPECT_NE(svg.find("<title>" + from + "&#45;&gt;" + to + "</title>"), std::string::npos) << line;
    }
    std::size_t drawn = 0;
    for (std::size_t at = svg.find("class=\"edge\""); at != std::string::npos;
         at = svg.find("class=\"edge\"", at + 1)) {
        ++drawn;
    }
    EXPECT_EQ(drawn, edges);
    EXPECT_GT(edges, 15U);
}

} // namespace
} // namespace frustumscreen::exhibit
