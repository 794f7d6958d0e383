"""Programs that play the exhibit's devices: for the emulated machine, for tests, for a bench without the device."""
