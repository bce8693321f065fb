// How one coordinate in [0, 1] varies from parents to children. Powers and roots are products and square roots, so that
// the bits are the same on every machine.
#pragma once

#include "optimize/random_stream.hpp"

namespace formotion {

// Simulated binary crossover within bounds (Deb, Agrawal 1994), index 15: one of the two children, on either side of
// the parents' middle alike.
double crossed(double a, double b, RandomStream& random);

// Polynomial mutation within bounds (Deb, Goyal 1996), index 15.
double mutated(double at, RandomStream& random);

// at + by (Storn, Price 1997); where that leaves [0, 1], a random place between `at` and the bound.
double stepped(double at, double by, RandomStream& random);

}  // namespace formotion
