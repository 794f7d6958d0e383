/// Limits Mesa to its most robust rendering: on the processor, in one thread, with vectors of 128 bits and
/// instructions that every x86-64 PC of the last fifteen years has, and without shaders cached on a disk.
///
/// Threads  call it while the process has one thread and no display; Mesa reads the environment.
/// Source   Mesa 22.3, docs/envvars.rst; GBM_ALWAYS_SOFTWARE: src/gbm/backends/dri/gbm_dri.c.
#pragma once

namespace frustumscreen::display {

void draw_plainly();

} // namespace frustumscreen::display
