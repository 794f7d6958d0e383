#include "app/programs/frustumscreen/states/states_command.h"

#include "app/exhibit/states_page.h"
#include "app/programs/common/command_line.h"

#include <fmt/format.h>

namespace frustumscreen::programs {

int states_command(int argc, char** argv) {
    bool dot = false;
    CommandLine app("Prints the table of the exhibit's states and events as Markdown.",
                    "frustumscreen states");
    app.add_flag("--dot", dot, "print a graph for Graphviz instead");
    if (const auto end = app.end_of_arguments(argc, argv)) {
        return *end;
    }
    fmt::print("{}", dot ? exhibit::states_graph() : exhibit::states_page());
    return 0;
}

} // namespace frustumscreen::programs
