// Figures of a preparation, as `info` and `prepare` print them.
#pragma once

#include "app/frame/text_table.hpp"
#include "cells/rooms/leaks.hpp"
#include "run/prepare.hpp"

namespace enfilade {

/// Cells by kind, portals, clusters, G_cell, G_cluster.
void add_prepared_figures(TextTable& table, const Prepared& prepared);
/// How many leaks of each kind, and the way of the first.
void add_leaks(TextTable& table, const std::vector<Leak>& leaks);
/// Time and peak memory, step by step.
void add_prepare_cost(TextTable& table, const Prepared& prepared);

}  // namespace enfilade
