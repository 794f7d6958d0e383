/// `frustumscreen counts`: how often, when and for how long the exhibit is used, as text, a table or a picture.
#pragma once

namespace frustumscreen::programs {

int counts_command(int argc, char** argv);

} // namespace frustumscreen::programs
