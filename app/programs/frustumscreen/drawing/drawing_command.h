/// frustumscreen drawing: technical drawings of the table and the prop, from the settings.
#pragma once

namespace frustumscreen {

int drawing_command(int argc, char** argv);

} // namespace frustumscreen
