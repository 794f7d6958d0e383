/// The mocked tracker in a process beside the test, with its bytes at a Unix socket, and a bus that finds it there.
///
/// Threads  one caller.
/// Errors   an error of the process fails the test; without a socket no tracker is connected.
#pragma once

#include "firmware_host/tracker/usb_transport.h"

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen::tests {

class MockProcess {
public:
    /// Runs tests/hil/mock_tracker with these arguments; it listens for commands at `control`.
    MockProcess(std::vector<std::string> arguments, std::string control);
    ~MockProcess();
    MockProcess(const MockProcess&) = delete;
    MockProcess& operator=(const MockProcess&) = delete;

    /// Sends a command and returns the answer, one JSON object; empty: it did not answer.
    [[nodiscard]] std::string tell(const std::string& command) const;

private:
    std::string control_;
    pid_t process_ = -1;
};

/// Finds the tracker whose bytes are at the Unix socket `path`.
[[nodiscard]] std::unique_ptr<tracker::UsbBus> make_socket_bus(std::string path,
                                                               tracker::UsbTrackerModel model);

} // namespace frustumscreen::tests
