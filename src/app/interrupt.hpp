// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

/// Makes SIGINT and SIGTERM ask for an orderly end; a second one ends the process at once.
void catch_interrupts();

/// True once an end was asked for.
bool interrupted();

}  // namespace lego_loam_sc
