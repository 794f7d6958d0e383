/// A thread's name, for whoever looks at the process from outside (`top -H`, a debugger): at most 15 bytes.
#pragma once

#include <pthread.h>

namespace frustumscreen {

inline void name_this_thread(const char* name) {
    ::pthread_setname_np(::pthread_self(), name);
}

} // namespace frustumscreen
