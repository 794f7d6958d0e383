#include "app/exhibit/states_page.h"

#include "app/exhibit/states.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

namespace frustumscreen::exhibit {

namespace {

/// The events that lead from one state to another, in their order.
std::vector<Event> events_between(State from, State to) {
    std::vector<Event> events;
    for (const Transition& row : transitions) {
        if (row.from == from && row.to == to) {
            events.push_back(row.on);
        }
    }
    std::sort(events.begin(), events.end());
    return events;
}

/// Transitions to staff and fault, which come from nearly every state, are drawn from attract alone.
bool is_drawn(State from, State to) {
    return from == State::Attract || (to != State::Staff && to != State::Fault);
}

/// A label on a white ground, so that no line runs through its letters.
std::string label_of(const std::vector<Event>& events) {
    std::string rows;
    for (const Event event : events) {
        rows += fmt::format("<tr><td bgcolor=\"white\">{}</td></tr>", note_of(event).name);
    }
    return fmt::format(
        "<<table border=\"0\" cellborder=\"0\" cellspacing=\"0\" cellpadding=\"1\">{}</table>>", rows);
}

/// Arranges the states so that few lines cross.
constexpr std::string_view layout = "  rankdir=TB; nodesep=1.0; ranksep=0.9; bgcolor=white;\n"
                                    "  node [shape=box, style=\"rounded,filled\", fillcolor=\"#eef3f8\", "
                                    "color=\"#334455\", fontname=\"Noto Sans\", "
                                    "fontsize=16, margin=\"0.2,0.1\"];\n"
                                    "  edge [color=\"#334455\", fontname=\"Noto Sans\", fontsize=13];\n"
                                    "  {rank=same; staff; attract; fault}\n"
                                    "  {rank=same; browse; guide; degraded}\n"
                                    "  staff -> attract -> fault [style=invis];\n"
                                    "  browse -> guide -> degraded [style=invis];\n";

} // namespace

std::string states_page() {
    std::string page =
        "# States\n\n"
        "The exhibit is a state machine: the table in `app/exhibit/states.h` has its states, events and "
        "transitions. The event rest\n"
        "leads from every state to attract. The status file and the staff's picture name the state. While "
        "the exhibit sleeps by its\n"
        "timetable (docs/technicians.md), the status file says `asleep` instead, and the state machine runs "
        "on in the dark.\n"
        "`frustumscreen states` writes this page, `frustumscreen states --dot` the diagram's source for "
        "Graphviz.\n\n"
        "![The states and the events that lead from one to the other](states.svg)\n\n"
        "In the diagram rest is grey. A chord leads to staff from every other state. Nothing to show leads "
        "to "
        "fault from every state\n"
        "but staff. Both are drawn from attract only.\n\n"
        "| state | what is shown and said |\n|---|---|\n";
    auto out = std::back_inserter(page);
    for (const StateNote& state : state_notes) {
        fmt::format_to(out, "| {} | {} |\n", state.name, state.shows);
    }
    page +=
        "\nMost events are conditions: each is raised in every step in which it holds. Within a step events "
        "are raised in this "
        "order:\n\n| event | when |\n|---|---|\n";
    for (const EventNote& event : event_notes) {
        fmt::format_to(out, "| {} | {} |\n", event.name, event.when);
    }
    page += "\nThe state after each event; an empty cell: the state stays.\n\n|";
    for (const StateNote& state : state_notes) {
        fmt::format_to(out, " | {}", state.name);
    }
    page += " |\n|---|";
    for (std::size_t k = 0; k < state_count; ++k) {
        page += "---|";
    }
    page += "\n";
    for (const EventNote& event : event_notes) {
        fmt::format_to(out, "| {}", event.name);
        for (const StateNote& state : state_notes) {
            const State to = next(state.state, event.event);
            fmt::format_to(out, " | {}", to == state.state ? std::string_view() : name_of(to));
        }
        page += " |\n";
    }
    return page;
}

std::string states_graph() {
    std::string graph = fmt::format("digraph states {{\n{}", layout);
    for (const StateNote& from : state_notes) {
        for (const StateNote& to : state_notes) {
            const std::vector<Event> events = events_between(from.state, to.state);
            if (events.empty() || !is_drawn(from.state, to.state)) {
                continue;
            }
            const bool rest = events == std::vector{Event::Rest};
            graph += fmt::format("  {} -> {} [{}];\n", from.name, to.name,
                                 rest ? "color=\"#b8b8b8\"" : "label=" + label_of(events));
        }
    }
    return graph + "}\n";
}

} // namespace frustumscreen::exhibit
