#include "app/programs/frustumscreen/states_command.h"

#include "app/exhibit/states_page.h"
#include "app/programs/common/read_arguments.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace frustumscreen {

int states_command(int argc, char** argv) {
    bool dot = false;
    CLI::App app("Prints the exhibit's states and what leads from one to the other, in Markdown.",
                 "frustumscreen states");
    app.add_flag("--dot", dot, "the same as a graph, in the language of Graphviz");
    if (const auto end = end_of_arguments(app, argc, argv)) {
        return *end;
    }
    fmt::print("{}", dot ? states_graph() : states_page());
    return 0;
}

} // namespace frustumscreen
