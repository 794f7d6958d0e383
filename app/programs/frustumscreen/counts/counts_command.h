/// `frustumscreen counts`: how often, when and for how long the exhibit is used, as text, a table or a picture.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'counts'. Exit status: 0 done, 1 the work failed or a file of the counts cannot be read, 2 wrong
/// use.
int counts_command(int argc, char** argv);

} // namespace frustumscreen::programs
