#include <periodyn.hpp>
#include <periodyn.hpp>
