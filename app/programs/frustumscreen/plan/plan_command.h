/// `frustumscreen plan`: what the exhibit needs of a pack and of the machine, what it leaves out and why, and what that
/// saves, measured on this machine.
#pragma once

namespace frustumscreen::programs {

/// Arguments after 'plan'. Exit status: 0 done, 1 the work failed, 2 wrong use.
int plan_command(int argc, char** argv);

} // namespace frustumscreen::programs
