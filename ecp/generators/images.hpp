// Images of an embodied agent: X { c; EffectorReply e; ...; i, i_0 }, Y { c; EffectorCommand e; ... }.
#pragma once
#include "base/effector_command.hpp"
#include "base/transmission.hpp"

namespace mrroc::ecp {

/// A part of an image that an agent does not have.
struct None {};

/// Images of an agent whose memory is C. An agent of a task is `struct Arm : ArmAgent<Memory> {}`.
template <class C>
struct ArmAgent {
  /// x: memory c, reply e of the effector, reading V of the virtual sensor, order T of the coordinator, macrostep i,
  /// and i_0 in which the behaviour began.
  struct X {
    C c{};
    EffectorReply e;
    SensorReading V;
    Order T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  /// y: the new memory c, command e to the effector, nothing for the sensor, report T to the coordinator.
  struct Y {
    C c{};
    EffectorCommand e;
    None V;
    Report T;
  };
};

}  // namespace mrroc::ecp
