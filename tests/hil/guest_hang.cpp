/// Preloaded into the exhibit in the emulated machine (LD_PRELOAD): makes a call into a library wait as long as a file
/// exists, as a broken driver would; if the file contains a number, for that many milliseconds, once.
///
/// /run/hil/hang-gl    the next glClear, on the render thread
/// /run/hil/hang-usb   the next bulk transfer, on the tracker's thread
/// /run/hil/hang-connector   the next query of the connectors, on their thread
///
/// /run/hil/crash-driver     does not hang: each thread that llvmpipe starts ends the process with SIGSEGV
#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

namespace {

constexpr unsigned nap_us = 50000;

void wait_while_there(const char* file) {
    unsigned once_ms = 0;
    if (::access(file, F_OK) == 0 && std::ifstream(file) >> once_ms) {
        ::unlink(file);
        ::usleep(1000 * once_ms);
    }
    while (::access(file, F_OK) == 0) {
        ::usleep(nap_us);
    }
}

template <typename Function> Function* real(const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name)); // as POSIX prescribes for dlsym
}

} // namespace

extern "C" {

void glClear(unsigned mask) {
    static auto* const clear = real<void(unsigned)>("glClear");
    wait_while_there("/run/hil/hang-gl");
    clear(mask);
}

/// Mesa names each of its threads when the thread starts.
int pthread_setname_np(pthread_t thread, const char* name) {
    static auto* const set_name = real<int(pthread_t, const char*)>("pthread_setname_np");
    const int result = set_name(thread, name);
    if (std::strncmp(name, "llvmpipe-", 9) == 0 && ::access("/run/hil/crash-driver", F_OK) == 0) {
        volatile int* const nowhere = nullptr;
        *nowhere = 1;
    }
    return result;
}

void* drmModeGetConnectorCurrent(int card, unsigned connector) {
    static auto* const get = real<void*(int, unsigned)>("drmModeGetConnectorCurrent");
    wait_while_there("/run/hil/hang-connector");
    return get(card, connector);
}

int libusb_bulk_transfer(void* handle, unsigned char endpoint, unsigned char* data, int length, int* done,
                         unsigned timeout_ms) {
    static auto* const transfer =
        real<int(void*, unsigned char, unsigned char*, int, int*, unsigned)>("libusb_bulk_transfer");
    wait_while_there("/run/hil/hang-usb");
    return transfer(handle, endpoint, data, length, done, timeout_ms);
}
}
