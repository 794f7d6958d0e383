/// `frustumscreen drawing`: draws the table and the prop to scale, from the settings.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'drawing'. Exit status: 0 done, 1 the work failed, 2 wrong use.
int drawing_command(int argc, char** argv);

} // namespace frustumscreen::programs
