/// `frustumscreen guide`: what the visitor of each pose in a file sees, what of it is lit, and the advice.
#pragma once

namespace frustumscreen {

int guide_command(int argc, char** argv);

} // namespace frustumscreen
