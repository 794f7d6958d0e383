#include "app/programs/frustumscreen/states_command.h"

#include "app/exhibit/states_page.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace frustumscreen {

int states_command(int argc, char** argv) {
    bool dot = false;
    CLI::App app("Prints the exhibit's states and what leads from one to the other, in Markdown.",
                 "frustumscreen states");
    app.add_flag("--dot", dot, "the same as a graph, in the language of Graphviz");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    fmt::print("{}", dot ? states_graph() : states_page());
    return 0;
}

} // namespace frustumscreen
