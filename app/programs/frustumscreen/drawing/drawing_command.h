/// `frustumscreen drawing`: draws the table and the prop to scale, from the settings.
#pragma once

namespace frustumscreen::programs {

int drawing_command(int argc, char** argv);

} // namespace frustumscreen::programs
