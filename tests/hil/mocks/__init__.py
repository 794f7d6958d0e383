"""Devices of the exhibit, played by a program: for the emulated machine, for tests, for a bench without the device."""
