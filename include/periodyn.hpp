/**
 * @file periodyn.hpp
 * Periodyn for C++17: periodyn.h with handles that free themselves, exceptions and std containers.
 *
 * Functions have the names of periodyn.h without the prefix, and its documentation holds. In short:
 *
 * - What fails throws periodyn::error. That a solve did not converge is no error, but an Outcome.
 * - Callbacks may be lambdas, and may throw: the exception comes out of the call that needed them.
 * - Handles can be moved, not copied; using one that was moved from throws PDN_ERR_NULL.
 * - Arrays come as std::vector, those of fixed size as std::array; components of each time
 * together.
 * - With PERIODYN_EIGEN defined, or Eigen/Core included before, periodyn::array and periodyn::view
 *   convert between these and Eigen's matrices.
 */

#ifndef PERIODYN_HPP
#define PERIODYN_HPP

#include <periodyn.h>

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace periodyn
{

/** In place of a node's id: the ground. */
constexpr std::int32_t ground = PDN_GROUND;
/** Ids of what was added first; those of the others of a kind follow. */
constexpr std::int32_t first_node = PDN_FIRST_NODE, first_joint = PDN_FIRST_JOINT,
                       first_beam_element = PDN_FIRST_BEAM_ELEMENT,
                       first_shell_element = PDN_FIRST_SHELL_ELEMENT,
                       first_force = PDN_FIRST_FORCE, first_relation = PDN_FIRST_RELATION,
                       first_parameter = PDN_FIRST_PARAMETER, first_load = PDN_FIRST_LOAD,
                       first_beam_load = PDN_FIRST_BEAM_LOAD,
                       first_shell_load = PDN_FIRST_SHELL_LOAD,
                       first_inertia = PDN_FIRST_INERTIA,
                       first_prescribed = PDN_FIRST_PRESCRIBED;

/** A point or a direction. */
using Vector3 = std::array<double, 3>;
/** A 3 x 3 matrix, column by column. */
using Matrix3 = std::array<double, 9>;
/** Linear and angular velocity, or force and moment. */
using Vector6 = std::array<double, 6>;
/** A 6 x 6 matrix, column by column. */
using Matrix6 = std::array<double, 36>;
/** Numbers along two directions of a surface. */
using Counts = std::array<std::size_t, 2>;
/** C components at each of many times, or for each of many harmonics. */
template <std::size_t C> using Series = std::vector<std::array<double, C>>;

/** Numbers of the caller, looked at during a call only. */
template <class T> class View
{
  public:
    View() = default;
    View(const T *data, std::size_t size) : data_(size == 0 ? &nothing : data), size_(size)
    {
    }
    View(const std::vector<T> &vector) : View(vector.data(), vector.size())
    {
    }
    View(std::initializer_list<T> list) : View(list.begin(), list.size())
    {
    }
    template <std::size_t N> View(const std::array<T, N> &array) : View(array.data(), N)
    {
    }
    template <std::size_t N> View(const T (&array)[N]) : View(array, N)
    {
    }
    const T *data() const
    {
        return data_;
    }
    std::size_t size() const
    {
        return size_;
    }

  private:
    static constexpr T nothing{}; // so that none is no NULL
    const T *data_ = &nothing;
    std::size_t size_ = 0;
};
using Reals = View<double>;
using Ids = View<std::int32_t>;

/** @name Choices, as the constants of periodyn.h */
///@{
enum class Coordinate : std::int32_t {
    displacement = PDN_DISPLACEMENT,
    displacement_2 = PDN_DISPLACEMENT_2,
    displacement_3 = PDN_DISPLACEMENT_3,
    rotation = PDN_ROTATION,
    rotation_2 = PDN_ROTATION_2,
    rotation_3 = PDN_ROTATION_3,
};
enum class JointKind : std::int32_t {
    rigid = PDN_JOINT_RIGID,
    revolute = PDN_JOINT_REVOLUTE,
    universal = PDN_JOINT_UNIVERSAL,
    spherical = PDN_JOINT_SPHERICAL,
    prismatic = PDN_JOINT_PRISMATIC,
    cylindrical = PDN_JOINT_CYLINDRICAL,
    planar = PDN_JOINT_PLANAR,
    free = PDN_JOINT_FREE,
    screw = PDN_JOINT_SCREW, ///< of pdn_joint_info only
    strut = PDN_JOINT_STRUT, ///< likewise
};
enum class Frame : std::int32_t {
    space = PDN_FRAME_SPACE,
    material = PDN_FRAME_MATERIAL,
    untwisted = PDN_FRAME_UNTWISTED, ///< of loads along beams only
};
enum class ShellFrames : std::int32_t {
    normals = PDN_SHELL_NORMALS,
    parallel = PDN_SHELL_PARALLEL,
    node_axes = PDN_SHELL_NODE_AXES,
};
enum class ShellPlace : std::int32_t {
    edge_start_eta = PDN_SHELL_EDGE_START_ETA,
    edge_end_xi = PDN_SHELL_EDGE_END_XI,
    edge_end_eta = PDN_SHELL_EDGE_END_ETA,
    edge_start_xi = PDN_SHELL_EDGE_START_XI,
    surface = PDN_SHELL_SURFACE,
};
enum class Component : std::int32_t {
    force_1 = PDN_FORCE_1,
    force_2 = PDN_FORCE_2,
    force_3 = PDN_FORCE_3,
    moment_1 = PDN_MOMENT_1,
    moment_2 = PDN_MOMENT_2,
    moment_3 = PDN_MOMENT_3,
};
enum class Tangents : std::int32_t {
    differenced = PDN_TANGENTS_DIFFERENCED,
    given = PDN_TANGENTS_GIVEN,
};
enum class Tangent : std::int32_t { motion = PDN_TANGENT_MOTION, velocity = PDN_TANGENT_VELOCITY };
enum class Axes : std::int32_t {
    space = PDN_FRAME_SPACE,
    first = PDN_FRAME_FIRST,
    second = PDN_FRAME_SECOND,
};
enum class Outcome : std::int32_t {
    converged = PDN_CONVERGED,
    iteration_limit = PDN_ITERATION_LIMIT,
    stalled = PDN_STALLED,
    singular = PDN_SINGULAR,
    cancelled = PDN_CANCELLED,
    no_initial_guess = PDN_NO_INITIAL_GUESS,
    inconsistent = PDN_INCONSISTENT,
    wrong_assembly = PDN_WRONG_ASSEMBLY,
    tolerance_not_met = PDN_TOLERANCE_NOT_MET,
    work_limit = PDN_WORK_LIMIT,
};
/** How the upper half of harmonics falls, as pdn_diagnostics.decay tells. */
enum class Decay : std::int32_t {
    unknown = PDN_DECAY_UNKNOWN,
    fast = PDN_DECAY_FAST,
    slow = PDN_DECAY_SLOW,
    rounding = PDN_DECAY_ROUNDING,
};
/** The parameter that every model has: the circular frequency. */
constexpr std::int32_t frequency = PDN_FREQUENCY;

/** A number of the model that a parameter moves. */
enum class Number : std::int32_t {
    stiffness = PDN_NUMBER_STIFFNESS,
    damping = PDN_NUMBER_DAMPING,
    rest = PDN_NUMBER_REST,
    inertia = PDN_NUMBER_INERTIA,
    beam_stiffness = PDN_NUMBER_BEAM_STIFFNESS,
    beam_mass = PDN_NUMBER_BEAM_MASS,
    beam_damping = PDN_NUMBER_BEAM_DAMPING,
    mass_damping = PDN_NUMBER_MASS_DAMPING,
    shell_stiffness = PDN_NUMBER_SHELL_STIFFNESS,
    shell_mass = PDN_NUMBER_SHELL_MASS,
    shell_damping = PDN_NUMBER_SHELL_DAMPING,
    shell_thickness = PDN_NUMBER_SHELL_THICKNESS,
    frame_rate = PDN_NUMBER_FRAME_RATE,
};

/** What of a quantity a condition holds. */
enum class Feature : std::int32_t {
    mean = PDN_FEATURE_MEAN,
    cosine = PDN_FEATURE_COSINE,
    sine = PDN_FEATURE_SINE,
    value = PDN_FEATURE_VALUE,
    /** The largest and the smallest value over the period: of sensitivities only. */
    largest = PDN_FEATURE_LARGEST,
    smallest = PDN_FEATURE_SMALLEST,
};

/** How sensitivities are found: by a linear solve for each parameter or for each dependent. */
enum class SensitivityMethod : std::int32_t {
    automatic = PDN_SENSITIVITY_AUTOMATIC,
    direct = PDN_SENSITIVITY_DIRECT,
    adjoint = PDN_SENSITIVITY_ADJOINT,
};

/** What has a signal that a parameter moves. */
enum class SignalOf : std::int32_t {
    actuator = PDN_SIGNAL_OF_ACTUATOR,
    prescribed = PDN_SIGNAL_OF_PRESCRIBED,
    load = PDN_SIGNAL_OF_LOAD,
    beam_load = PDN_SIGNAL_OF_BEAM_LOAD,
    gravity = PDN_SIGNAL_OF_GRAVITY,
    relation = PDN_SIGNAL_OF_RELATION,
    shell_load = PDN_SIGNAL_OF_SHELL_LOAD,
};

/** What has an id and may have a label. */
enum class ObjectKind : std::int32_t {
    node = PDN_OBJECT_NODE,
    joint = PDN_OBJECT_JOINT,
    beam_element = PDN_OBJECT_BEAM_ELEMENT,
    shell_element = PDN_OBJECT_SHELL_ELEMENT,
    force = PDN_OBJECT_FORCE,
    relation = PDN_OBJECT_RELATION,
    load = PDN_OBJECT_LOAD,
    beam_load = PDN_OBJECT_BEAM_LOAD,
    shell_load = PDN_OBJECT_SHELL_LOAD,
    inertia = PDN_OBJECT_INERTIA,
    prescribed = PDN_OBJECT_PRESCRIBED,
};

/** Kinds of pdn_force_info. */
enum class ForceKind : std::int32_t {
    spring_damper = PDN_FORCE_IS_SPRING_DAMPER,
    actuator = PDN_FORCE_IS_ACTUATOR,
    coordinate_law = PDN_FORCE_IS_COORDINATE_LAW,
    viscoelastic = PDN_FORCE_IS_VISCOELASTIC,
    viscous_damper = PDN_FORCE_IS_VISCOUS_DAMPER,
    bushing = PDN_FORCE_IS_BUSHING,
    user_force = PDN_FORCE_IS_USER_FORCE,
    controller = PDN_FORCE_IS_CONTROLLER,
    surface_force = PDN_FORCE_IS_SURFACE_FORCE,
};

/** Numbers of a force. */
enum class ForceNumber : std::int32_t {
    stiffness = PDN_NUMBER_STIFFNESS,
    damping = PDN_NUMBER_DAMPING,
    relaxation_time = PDN_NUMBER_RELAXATION_TIME,
};

/** A coordinate of a linear relation, and its coefficient. */
struct RelationTerm {
    std::int32_t joint;
    Coordinate coordinate;
    double coefficient;
};

/** A load along beam elements: its signals times factors, linear between fractions of their length; 1 if there are
 * none. axis_2 is the direction of Frame::untwisted. */
struct BeamLoad {
    std::int32_t first_element = 0, elements = 0;
    Frame frame = Frame::space;
    std::array<double, 3> axis_2{};
    std::vector<double> fractions, factors;
};

/** A load on shell elements. */
struct ShellLoad {
    std::int32_t first_element = 0, elements = 0;
    ShellPlace place = ShellPlace::surface;
    Frame frame = Frame::space;
};

/** Bytes of a label at most. */
constexpr std::int32_t longest_label = PDN_LABEL_LENGTH;

/** How a bushing measures rotations. */
enum class BushingAngles : std::int32_t {
    rotation_vector = PDN_ANGLES_ROTATION_VECTOR,
    tilt_and_spin = PDN_ANGLES_TILT_AND_SPIN,
};

/** The part of a signal that a parameter moves. */
enum class SignalPart : std::int32_t {
    mean = PDN_PART_MEAN,
    rate = PDN_PART_RATE,
    amplitude = PDN_PART_AMPLITUDE,
    phase = PDN_PART_PHASE,
};

/** Why a branch ended. */
enum class BranchEnd : std::int32_t {
    range = PDN_BRANCH_RANGE,
    closed = PDN_BRANCH_CLOSED,
    point_limit = PDN_BRANCH_POINT_LIMIT,
    smallest_step = PDN_BRANCH_SMALLEST_STEP,
    cancelled = PDN_BRANCH_CANCELLED,
    no_start = PDN_BRANCH_NO_START,
    failed = PDN_BRANCH_FAILED,
};

/** What happens at a point of a branch: values of pdn_branch_point.event. */
enum class BranchEvent : std::int32_t {
    none = PDN_EVENT_NONE,
    fold = PDN_EVENT_FOLD,
    branch_point = PDN_EVENT_BRANCH_POINT,
    period_doubling = PDN_EVENT_PERIOD_DOUBLING,
    torus = PDN_EVENT_TORUS,
};

/** How linear equations are solved, as pdn_periodic_options.linear_solver asks for and pdn_diagnostics tells. */
enum class Linear : std::int32_t {
    automatic = PDN_LINEAR_AUTOMATIC,
    direct = PDN_LINEAR_DIRECT,
    iterative = PDN_LINEAR_ITERATIVE,
    body_circulant = PDN_LINEAR_BODY_CIRCULANT,
    time_local = PDN_LINEAR_TIME_LOCAL,
    circulant = PDN_LINEAR_CIRCULANT,
};
enum class Filter : std::int32_t {
    lanczos = PDN_FILTER_LANCZOS,
    exponential = PDN_FILTER_EXPONENTIAL,
};
enum class Stage : std::int32_t {
    initial_guess = PDN_STAGE_INITIAL_GUESS,
    newton = PDN_STAGE_NEWTON,
    march = PDN_STAGE_MARCH,
    modes = PDN_STAGE_MODES,
    stability = PDN_STAGE_STABILITY,
};
enum class Verdict : std::int32_t {
    not_known = PDN_STABILITY_NOT_KNOWN,
    stable = PDN_STABLE,
    unstable = PDN_UNSTABLE,
};
/** Where a periodic solve starts, as pdn_periodic_options.start asks for and pdn_progress tells. */
enum class Start : std::int32_t {
    automatic = PDN_START_AUTOMATIC,
    quasi_static = PDN_START_QUASI_STATIC,
    steady_rotation = PDN_START_STEADY_ROTATION,
    rigid_rotation = PDN_START_RIGID_ROTATION,
    raised_inertia = PDN_START_RAISED_INERTIA,
    march = PDN_START_MARCH,
    lowered_damping = PDN_START_LOWERED_DAMPING,
    raised_loads = PDN_START_RAISED_LOADS,
};
/** Where the points of grids are, as pdn_periodic_options.time_map asks for. */
enum class TimeMap : std::int32_t {
    automatic = PDN_TIME_MAP_AUTOMATIC,
    equispaced = PDN_TIME_MAP_EQUISPACED,
    events = PDN_TIME_MAP_EVENTS,
};
/** Kinds of quantities that are asked of solutions. */
enum class Kind : std::int32_t {
    position = PDN_NODE_POSITION,
    rotation = PDN_NODE_ROTATION,
    quaternion = PDN_NODE_QUATERNION,
    velocity = PDN_NODE_VELOCITY,
    acceleration = PDN_NODE_ACCELERATION,
    coordinate = PDN_JOINT_COORDINATE,
    coordinate_rate = PDN_JOINT_RATE,
    coordinate_acceleration = PDN_JOINT_ACCELERATION,
    driving_effort = PDN_JOINT_DRIVING_EFFORT,
    reaction = PDN_JOINT_REACTION,
    strain = PDN_BEAM_STRAIN,
    beam_force = PDN_BEAM_FORCE,
    beam_force_mean = PDN_BEAM_FORCE_MEAN,
    beam_force_jump = PDN_BEAM_FORCE_JUMP,
    effort = PDN_FORCE_EFFORT,
    branch_effort = PDN_FORCE_BRANCH_EFFORT,
    branch_elongation = PDN_FORCE_BRANCH_ELONGATION,
    force_on_node = PDN_FORCE_ON_NODE,
    bushing_efforts = PDN_FORCE_BUSHING_EFFORTS,
    control_effort = PDN_FORCE_CONTROL_EFFORT,
    control_state = PDN_FORCE_CONTROL_STATE,
    relation_effort = PDN_RELATION_EFFORT,
    shell_strain = PDN_SHELL_STRAIN,
    shell_resultant = PDN_SHELL_RESULTANT,
    stress_top = PDN_SHELL_STRESS_TOP,
    stress_bottom = PDN_SHELL_STRESS_BOTTOM,
};
///@}

/** What a call that fails throws: the status, and what was expected and what came. */
class error : public std::runtime_error
{
  public:
    error(pdn_status status, const std::string &message)
        : std::runtime_error(message), status_(status)
    {
    }
    /** PDN_ERR_VALUE, ... */
    pdn_status status() const noexcept
    {
        return status_;
    }

  private:
    pdn_status status_;
};

/** How functions of the library are called. */
namespace detail
{

/** What a callback threw on this thread, on its way to the call that failed by it. */
inline thread_local std::exception_ptr carried;

/** The text that a function with a buffer writes. */
template <class Write> std::string text(Write write)
{
    std::string text(write(nullptr, 0), '\0');
    if (!text.empty()) {
        text.resize(write(text.data(), text.size() + 1));
    }
    return text;
}

/** Throws what a failed call has to say. */
inline void check(pdn_status status)
{
    const std::exception_ptr thrown = std::exchange(carried, nullptr);
    if (status == PDN_ERR_CALLBACK && thrown) {
        std::rethrow_exception(thrown);
    }
    if (status < 0) {
        throw error(status, text(pdn_last_error));
    }
}

/** Runs a function of the caller: 0, or 1 after it threw. */
template <class Function> std::int32_t guarded(Function &&function) noexcept
{
    try {
        function();
        return 0;
    } catch (const std::exception &exception) {
        carried = std::current_exception();
        pdn_set_callback_error(exception.what());
    } catch (...) {
        carried = std::current_exception();
    }
    return 1;
}

/** Disposes of a Function that the library owns. */
template <class Function> void destroy(void *function) noexcept
{
    delete static_cast<Function *>(function);
}

/** Hands a Function over to the library, for the time the call succeeds. */
template <class Function, class Call> void hand_over(Function function, Call call)
{
    auto owned = std::make_unique<Function>(std::move(function));
    check(call(owned.get(), &destroy<Function>));
    owned.release();
}

struct Free {
    void operator()(pdn_model *model) const noexcept
    {
        pdn_model_free(model);
    }
    void operator()(pdn_solution *solution) const noexcept
    {
        pdn_solution_free(solution);
    }
    void operator()(pdn_modes *modes) const noexcept
    {
        pdn_modes_free(modes);
    }
    void operator()(pdn_conditions *conditions) const noexcept
    {
        pdn_conditions_free(conditions);
    }
    void operator()(pdn_sensitivities *sensitivities) const noexcept
    {
        pdn_sensitivities_free(sensitivities);
    }
    void operator()(pdn_branch *branch) const noexcept
    {
        pdn_branch_free(branch);
    }
    void operator()(pdn_stability *stability) const noexcept
    {
        pdn_stability_free(stability);
    }
    void operator()(pdn_table *table) const noexcept
    {
        pdn_table_free(table);
    }
    void operator()(pdn_equations *equations) const noexcept
    {
        pdn_equations_free(equations);
    }
};

/** The handle that a function makes. */
template <class T, class Make> std::unique_ptr<T, Free> make(Make function)
{
    T *handle = nullptr;
    check(function(&handle));
    return std::unique_ptr<T, Free>(handle);
}

/** A number that a function writes. */
template <class T, class Write> T number(Write write)
{
    T value{};
    check(write(&value));
    return value;
}

/** Entries of fixed size as the plain numbers that they are. */
template <std::size_t C> const double *flat(const Series<C> &series)
{
    return reinterpret_cast<const double *>(series.data());
}
template <std::size_t C> double *flat(Series<C> &series)
{
    return reinterpret_cast<double *>(series.data());
}

template <class Enum> constexpr std::int32_t c(Enum value)
{
    return static_cast<std::int32_t>(value);
}

/** Functions of signals that the library may still call, kept by models and solutions. */
using Kept = std::vector<std::shared_ptr<const void>>;

} // namespace detail

/** @name The library */
///@{
inline std::string version()
{
    return pdn_version();
}
inline std::string build_info()
{
    return pdn_build_info();
}
inline std::string status_name(pdn_status status)
{
    return pdn_status_name(status);
}
inline std::string status_message(pdn_status status)
{
    return pdn_status_message(status);
}
/** For a library on top of this one: what pdn_last_error is to give on this thread. */
inline void set_last_error(const std::string &message)
{
    detail::check(pdn_set_last_error(message.c_str()));
}
/** What the last callback that failed on this thread returned; 1 if it threw. */
inline std::int32_t last_callback_code()
{
    return pdn_last_callback_code();
}
inline void set_panic_printing(bool enabled)
{
    pdn_set_panic_printing(enabled);
}
///@}

/** Cross-section of a beam; its matrices may also be written directly. */
struct Section : pdn_section {
    Section()
    {
        pdn_section_init(this, sizeof(pdn_section));
    }
    /** Without couplings: six stiffnesses; mass and three moments of inertia for each unit of
     * length. */
    Section(const std::array<double, 6> &stiffnesses, const std::array<double, 4> &masses)
        : Section()
    {
        detail::check(pdn_section_set_diagonal(this, stiffnesses.data(), masses.data()));
    }
    /** Damping = seconds * stiffness. */
    void set_proportional_damping(double seconds)
    {
        detail::check(pdn_section_set_proportional_damping(this, seconds));
    }
    /** Damping = diag(seconds) * stiffness: one time for each force and moment. */
    void set_component_damping(const std::array<double, 6> &seconds)
    {
        detail::check(pdn_section_set_component_damping(this, seconds.data()));
    }
};

/** Section of a shell; its matrices may also be written directly. */
struct ShellSection : pdn_shell_section {
    ShellSection()
    {
        pdn_shell_section_init(this, sizeof(pdn_shell_section));
    }
    /** Of one isotropic material. */
    ShellSection(double thickness, double young, double poisson, double density,
                 double drilling = 1.0, double drilling_gradient = 0.1)
        : ShellSection()
    {
        detail::check(pdn_shell_section_set_isotropic(this, thickness, young, poisson, density,
                                                      drilling, drilling_gradient));
    }
    /** Damping = seconds * stiffness. */
    void set_proportional_damping(double seconds)
    {
        detail::check(pdn_shell_section_set_proportional_damping(this, seconds));
    }
};

/** How a shell lies on its nodes. */
struct ShellPlacement : pdn_shell_placement {
    /** A direction of zero stands for axes as close to xi and eta as they can be. */
    ShellPlacement(ShellFrames kind = ShellFrames::normals, double distance = 0.0,
                   const Vector3 &axis_1 = {})
    {
        pdn_shell_placement_init(this, sizeof(pdn_shell_placement));
        frames = detail::c(kind);
        offset = distance;
        for (std::size_t i = 0; i < 3; ++i) {
            direction[i] = axis_1[i];
        }
    }
};

/** Sections along a beam, linear between stations. */
class Stations
{
  public:
    /** One section for all of the beam. */
    Stations(const Section &section) : sections_{section}
    {
    }
    /** At fractions of the span; with structural twist if there are as many angles. */
    Stations(std::vector<double> fractions, const std::vector<Section> &sections,
             std::vector<double> twists = {})
        : fractions_(std::move(fractions)), sections_(sections.begin(), sections.end()),
          twists_(std::move(twists))
    {
        if (fractions_.size() != sections_.size() ||
            (!twists_.empty() && twists_.size() != sections_.size())) {
            throw error(PDN_ERR_SIZE,
                        "stations: expected as many fractions and twists as sections");
        }
    }
    /** As the library takes it; valid while this object is. */
    pdn_stations get() const
    {
        pdn_stations stations;
        pdn_stations_init(&stations, sizeof stations);
        stations.count = sections_.size();
        stations.fractions = fractions_.empty() ? nullptr : fractions_.data();
        stations.sections = sections_.data();
        stations.twists = twists_.empty() ? nullptr : twists_.data();
        return stations;
    }

  private:
    std::vector<double> fractions_;
    std::vector<pdn_section> sections_;
    std::vector<double> twists_;
};

/** Reference line of a beam. */
class Line
{
  public:
    /** Writes position and a direction for axis 2 at a fraction of the curve. */
    using Curve = std::function<void(double fraction, Vector3 &position, Vector3 &axis_2)>;

    static Line straight(const Vector3 &start, const Vector3 &end, const Vector3 &axis_2)
    {
        Line line;
        detail::check(pdn_line_set_straight(&line.line_, start.data(), end.data(), axis_2.data()));
        return line;
    }
    static Line arc(const Vector3 &start, const Vector3 &point, const Vector3 &end,
                    const Vector3 &axis_2)
    {
        Line line;
        detail::check(
            pdn_line_set_arc(&line.line_, start.data(), point.data(), end.data(), axis_2.data()));
        return line;
    }
    static Line curve(Curve function)
    {
        Line line;
        line.curve_ = std::make_shared<Curve>(std::move(function));
        detail::check(pdn_line_set_curve(&line.line_, &evaluate, line.curve_.get()));
        return line;
    }
    /** As the library takes it; valid while this object is. */
    const pdn_line &get() const
    {
        return line_;
    }

  private:
    Line()
    {
        pdn_line_init(&line_, sizeof line_);
    }
    static std::int32_t evaluate(double fraction, double *position, double *axis_2,
                                 void *curve) noexcept
    {
        return detail::guarded([=] {
            Vector3 point{}, direction{};
            (*static_cast<Curve *>(curve))(fraction, point, direction);
            for (std::size_t i = 0; i < 3; ++i) {
                position[i] = point[i];
                axis_2[i] = direction[i];
            }
        });
    }

    pdn_line line_;
    std::shared_ptr<Curve> curve_;
};

/** A surface to mesh with shells: a point for each pair (u, v), each from 0 to 1. */
class Surface
{
  public:
    /** Gives the position at (u, v). */
    using Function = std::function<Vector3(double u, double v)>;

    static Surface parallelogram(const Vector3 &corner, const Vector3 &along_u,
                                 const Vector3 &along_v)
    {
        Surface made;
        detail::check(pdn_surface_set_parallelogram(&made.surface_, corner.data(), along_u.data(),
                                                    along_v.data()));
        return made;
    }
    static Surface annulus(const Vector3 &centre, const Vector3 &axis, const Vector3 &start,
                           double inner, double outer, double angle)
    {
        Surface made;
        detail::check(pdn_surface_set_annulus(&made.surface_, centre.data(), axis.data(),
                                              start.data(), inner, outer, angle));
        return made;
    }
    static Surface cylinder(const Vector3 &centre, const Vector3 &axis, const Vector3 &start,
                            double radius, double length, double angle)
    {
        Surface made;
        detail::check(pdn_surface_set_cylinder(&made.surface_, centre.data(), axis.data(),
                                               start.data(), radius, length, angle));
        return made;
    }
    static Surface function(Function function)
    {
        Surface made;
        made.function_ = std::make_shared<Function>(std::move(function));
        detail::check(
            pdn_surface_set_function(&made.surface_, &evaluate, made.function_.get()));
        return made;
    }
    /** As the library takes it; valid while this object is. */
    const pdn_surface &get() const
    {
        return surface_;
    }

  private:
    Surface()
    {
        pdn_surface_init(&surface_, sizeof surface_);
    }
    static std::int32_t evaluate(double u, double v, double *position, void *function) noexcept
    {
        return detail::guarded([=] {
            const Vector3 point = (*static_cast<Function *>(function))(u, v);
            for (std::size_t i = 0; i < 3; ++i) {
                position[i] = point[i];
            }
        });
    }

    pdn_surface surface_;
    std::shared_ptr<Function> function_;
};

/** A scalar function of time. A number, or a function of time, is a signal too. */
class Signal
{
  public:
    Signal(double value) : Signal()
    {
        detail::check(pdn_signal_set_constant(&signal_, value));
    }
    /** A function double(double time), kept as long as models and solutions need it. */
    template <class F, class = std::enable_if_t<std::is_invocable_r_v<double, F &, double>>>
    Signal(F function) : Signal()
    {
        auto kept = std::make_shared<std::function<double(double)>>(std::move(function));
        detail::check(pdn_signal_set_function(&signal_, &evaluate, kept.get()));
        kept_ = std::move(kept);
    }
    /** A function double(double phase) of 2 pi t / T, for any period T. */
    template <class F> static Signal of_phase(F function)
    {
        auto kept = std::make_shared<std::function<double(double)>>(std::move(function));
        Signal signal;
        detail::check(
            pdn_signal_set_function_of_phase(&signal.signal_, &evaluate, kept.get()));
        signal.kept_ = std::move(kept);
        return signal;
    }
    /** mean + rate t + sum of cosines[j-1] cos(j w t) + sines[j-1] sin(j w t), w = 2 pi / period.
     */
    static Signal harmonics(double mean, double rate, std::vector<double> cosines,
                            std::vector<double> sines)
    {
        if (cosines.size() != sines.size()) {
            throw error(PDN_ERR_SIZE, "signal: expected as many sines as cosines");
        }
        using Arrays = std::pair<std::vector<double>, std::vector<double>>;
        auto kept = std::make_shared<const Arrays>(std::move(cosines), std::move(sines));
        Signal signal;
        detail::check(pdn_signal_set_harmonics(&signal.signal_, mean, rate, kept->first.data(),
                                               kept->second.data(), kept->first.size()));
        signal.kept_ = std::move(kept);
        return signal;
    }
    /** rate t + the trigonometric interpolation of equally spaced samples of one period. */
    static Signal samples(double rate, std::vector<double> samples)
    {
        auto kept = std::make_shared<const std::vector<double>>(std::move(samples));
        Signal signal;
        detail::check(pdn_signal_set_samples(&signal.signal_, rate, kept->data(), kept->size()));
        signal.kept_ = std::move(kept);
        return signal;
    }
    /** As the library takes it; valid while this object is. */
    const pdn_signal &get() const
    {
        return signal_;
    }
    /** What the library points to. */
    const std::shared_ptr<const void> &kept() const
    {
        return kept_;
    }

  private:
    Signal()
    {
        pdn_signal_init(&signal_, sizeof signal_);
    }
    static std::int32_t evaluate(double time, double *value, void *function) noexcept
    {
        return detail::guarded(
            [=] { *value = (*static_cast<std::function<double(double)> *>(function))(time); });
    }

    pdn_signal signal_;
    std::shared_ptr<const void> kept_;
};

/** An effort on a joint coordinate, with its derivatives. */
struct Effort {
    double effort;
    double by_coordinate;
    double by_rate;
};

/** What a user's forces may depend on: time and the motions of their nodes, counted from 0. */
class ForceState
{
  public:
    explicit ForceState(const pdn_force_state &state) : state_(state)
    {
    }
    double time() const
    {
        return state_.time;
    }
    std::size_t node_count() const
    {
        return state_.node_count;
    }
    Vector3 position(std::size_t node) const
    {
        return entry<3>(state_.positions, node);
    }
    Matrix3 rotation(std::size_t node) const
    {
        return entry<9>(state_.rotations, node);
    }
    /** Along the axes that the force was added with, as all that follows. */
    Vector6 velocity(std::size_t node) const
    {
        return entry<6>(state_.velocities, node);
    }

  private:
    template <std::size_t C>
    std::array<double, C> entry(const double *array, std::size_t node) const
    {
        if (node >= state_.node_count) {
            throw std::out_of_range("ForceState: no such node");
        }
        std::array<double, C> out;
        for (std::size_t i = 0; i < C; ++i) {
            out[i] = array[C * node + i];
        }
        return out;
    }

    const pdn_force_state &state_;
};

/** What a user's forces on shells may depend on: time and the motions of points, from 0 on. */
class SurfaceState
{
  public:
    explicit SurfaceState(const pdn_surface_state &state) : state_(state)
    {
    }
    double time() const
    {
        return state_.time;
    }
    /** Id of the shell element. */
    std::int32_t element() const
    {
        return state_.element;
    }
    std::size_t point_count() const
    {
        return state_.point_count;
    }
    /** xi and eta, from -1 to 1. */
    std::array<double, 2> place(std::size_t point) const
    {
        return entry<2>(state_.places, point);
    }
    /** Reference area, or length of an edge, that a point stands for. */
    double size(std::size_t point) const
    {
        return entry<1>(state_.sizes, point)[0];
    }
    Vector3 position(std::size_t point) const
    {
        return entry<3>(state_.positions, point);
    }
    /** Axes of the point; the third is the normal. */
    Matrix3 rotation(std::size_t point) const
    {
        return entry<9>(state_.rotations, point);
    }
    /** Along the axes that the force was added with, as all that follows. */
    Vector6 velocity(std::size_t point) const
    {
        return entry<6>(state_.velocities, point);
    }

  private:
    template <std::size_t C>
    std::array<double, C> entry(const double *array, std::size_t point) const
    {
        if (point >= state_.point_count) {
            throw std::out_of_range("SurfaceState: no such point");
        }
        std::array<double, C> out;
        for (std::size_t i = 0; i < C; ++i) {
            out[i] = array[C * point + i];
        }
        return out;
    }

    const pdn_surface_state &state_;
};

/** Where a user's forces on shells go, per area or length; all are zero at first. */
class SurfaceValues
{
  public:
    SurfaceValues(std::size_t point_count, pdn_surface_values &values)
        : points_(point_count), values_(values)
    {
    }
    /** Component 0, ... 5 of the force at a point and the moment about it. */
    double &force(std::size_t point, std::size_t component)
    {
        return values_.forces[6 * point + checked(point, component)];
    }
    /** Whether tangents are wanted; otherwise leave them. */
    bool tangents_wanted() const
    {
        return values_.by_motion != nullptr;
    }
    /** Derivative of a component at a point by a displacement or turn of this point. */
    double &by_motion(std::size_t point, std::size_t component, std::size_t of_component)
    {
        return tangent(values_.by_motion, point, component, of_component);
    }
    /** The same by a velocity or angular velocity. */
    double &by_velocity(std::size_t point, std::size_t component, std::size_t of_component)
    {
        return tangent(values_.by_velocity, point, component, of_component);
    }

  private:
    std::size_t checked(std::size_t point, std::size_t component) const
    {
        if (point >= points_ || component >= 6) {
            throw std::out_of_range("SurfaceValues: no such component");
        }
        return component;
    }
    double &tangent(double *blocks, std::size_t point, std::size_t row, std::size_t column)
    {
        if (blocks == nullptr) {
            throw std::logic_error("SurfaceValues: tangents are not wanted");
        }
        return blocks[36 * point + 6 * checked(point, column) + checked(point, row)];
    }

    std::size_t points_;
    pdn_surface_values &values_;
};

/** Where a user's forces go; all are zero at first. */
class ForceValues
{
  public:
    ForceValues(std::size_t node_count, pdn_force_values &values)
        : nodes_(node_count), values_(values)
    {
    }
    /** Component 0, ... 5 of the force on a node and the moment about it. */
    double &force(std::size_t node, std::size_t component)
    {
        return values_.forces[index(node, component)];
    }
    /** Whether tangents are wanted; otherwise leave them. */
    bool tangents_wanted() const
    {
        return values_.by_motion != nullptr;
    }
    /** Derivative of a node's component by a displacement or turn of a node. */
    double &by_motion(std::size_t node, std::size_t component, std::size_t of_node,
                      std::size_t of_component)
    {
        return tangent(values_.by_motion, index(node, component), index(of_node, of_component));
    }
    /** The same by a velocity or angular velocity. */
    double &by_velocity(std::size_t node, std::size_t component, std::size_t of_node,
                        std::size_t of_component)
    {
        return tangent(values_.by_velocity, index(node, component), index(of_node, of_component));
    }

  private:
    std::size_t index(std::size_t node, std::size_t component) const
    {
        if (node >= nodes_ || component >= 6) {
            throw std::out_of_range("ForceValues: no such component");
        }
        return 6 * node + component;
    }
    double &tangent(double *matrix, std::size_t row, std::size_t column)
    {
        if (matrix == nullptr) {
            throw std::logic_error("ForceValues: tangents are not wanted");
        }
        return matrix[6 * nodes_ * column + row];
    }

    std::size_t nodes_;
    pdn_force_values &values_;
};

/** What a controller may depend on: time, the coordinates that it reads, and its states. */
class ControllerState
{
  public:
    explicit ControllerState(const pdn_controller_state &state) : state_(state)
    {
    }
    double time() const
    {
        return state_.time;
    }
    double input(std::size_t number) const
    {
        return entry(state_.inputs, number, state_.input_count);
    }
    double input_rate(std::size_t number) const
    {
        return entry(state_.input_rates, number, state_.input_count);
    }
    double state(std::size_t number) const
    {
        return entry(state_.states, number, state_.state_count);
    }

  private:
    friend class ControllerValues;
    static double entry(const double *array, std::size_t number, std::size_t count)
    {
        if (number >= count) {
            throw std::out_of_range("ControllerState: no such entry");
        }
        return array[number];
    }

    const pdn_controller_state &state_;
};

/** Where a controller writes; all is zero at first. Rows of the tangents are the efforts, then the
    rates of the states. */
class ControllerValues
{
  public:
    ControllerValues(const ControllerState &state, pdn_controller_values &values)
        : inputs_(state.state_.input_count), states_(state.state_.state_count), values_(values)
    {
    }
    /** Effort on a coordinate that it acts on, towards growth. */
    double &effort(std::size_t output)
    {
        return values_.efforts[below(output, values_.output_count)];
    }
    double &state_rate(std::size_t state)
    {
        return values_.state_rates[below(state, states_)];
    }
    /** Whether tangents are wanted; otherwise leave them. */
    bool tangents_wanted() const
    {
        return values_.by_inputs != nullptr;
    }
    double &by_input(std::size_t row, std::size_t input)
    {
        return tangent(values_.by_inputs, row, below(input, inputs_));
    }
    double &by_input_rate(std::size_t row, std::size_t input)
    {
        return tangent(values_.by_input_rates, row, below(input, inputs_));
    }
    double &by_state(std::size_t row, std::size_t state)
    {
        return tangent(values_.by_states, row, below(state, states_));
    }

  private:
    static std::size_t below(std::size_t number, std::size_t count)
    {
        if (number >= count) {
            throw std::out_of_range("ControllerValues: no such entry");
        }
        return number;
    }
    double &tangent(double *matrix, std::size_t row, std::size_t column)
    {
        if (matrix == nullptr) {
            throw std::logic_error("ControllerValues: tangents are not wanted");
        }
        const std::size_t rows = values_.output_count + states_;
        return matrix[rows * column + below(row, rows)];
    }

    std::size_t inputs_, states_;
    pdn_controller_values &values_;
};

/** Total mass, and its centre. */
struct Mass {
    double mass;
    Vector3 centre;
};

/** A frame that turns steadily: an axis of length 1, an angle in a unit of time, a point. */
struct TurningFrame {
    Vector3 axis;
    double rate;
    Vector3 point;
};

/** A rotor whose blades are alike: an axis of length 1, a point of it, numbers of nodes. */
struct RotorSymmetry {
    Vector3 axis;
    Vector3 point;
    std::int32_t blades;
    std::int32_t nodes_of_blade;
    std::int32_t hub_nodes;
};

/** A mechanism, described in its reference configuration. Functions that add return ids. */
class Model
{
  public:
    using Id = std::int32_t;

    Model()
    {
        detail::check(pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR));
        handle_ = detail::make<pdn_model>(pdn_model_new);
    }
    /** Takes over a handle of periodyn.h; keeps the functions of signals that it may call. */
    explicit Model(pdn_model *handle, detail::Kept kept = {})
        : kept_(std::move(kept)), handle_(handle)
    {
    }
    /** The handle, for functions of periodyn.h; NULL if moved from. */
    pdn_model *get() const noexcept
    {
        return handle_.get();
    }
    /** The functions of signals that the model may call. */
    const detail::Kept &kept() const noexcept
    {
        return kept_;
    }

    /** A copy, which may be changed and solved apart from it. */
    Model copy() const
    {
        auto handle =
            detail::make<pdn_model>([&](pdn_model **out) { return pdn_model_copy(get(), out); });
        return Model(handle.release(), kept_);
    }
    /** Saves the model, without the functions it may call. */
    void save(const std::string &path) const
    {
        detail::check(pdn_model_save(get(), path.c_str()));
    }
    static Model load(const std::string &path)
    {
        auto handle = detail::make<pdn_model>(
            [&](pdn_model **out) { return pdn_model_load(path.c_str(), out); });
        return Model(handle.release());
    }

    /** @name What there is */
    ///@{
    Id node_count() const
    {
        return id([&](Id *out) { return pdn_model_node_count(get(), out); });
    }
    Id joint_count() const
    {
        return id([&](Id *out) { return pdn_model_joint_count(get(), out); });
    }
    Id element_count() const
    {
        return id([&](Id *out) { return pdn_model_element_count(get(), out); });
    }
    Id relation_count() const
    {
        return id([&](Id *out) { return pdn_model_relation_count(get(), out); });
    }
    Id force_count() const
    {
        return id([&](Id *out) { return pdn_model_force_count(get(), out); });
    }
    Mass mass() const
    {
        Mass out{};
        detail::check(pdn_model_mass(get(), &out.mass, out.centre.data()));
        return out;
    }
    pdn_frame node_frame(Id node) const
    {
        return detail::number<pdn_frame>(
            [&](pdn_frame *out) { return pdn_model_node_frame(get(), node, out); });
    }
    pdn_summary summary() const
    {
        pdn_summary out;
        pdn_summary_init(&out, sizeof out);
        detail::check(pdn_model_summary(get(), &out));
        return out;
    }
    /** The summary in readable lines, with warnings. */
    std::string describe() const
    {
        summary(); // throws if there is nothing to describe
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_model_describe(get(), buffer, capacity);
        });
    }
    /** Takes a label away if it is empty. */
    void set_label(ObjectKind kind, Id of, const std::string &label)
    {
        detail::check(pdn_model_set_label(get(), detail::c(kind), of, label.c_str()));
    }
    /** Empty if there is none. */
    std::string label(ObjectKind kind, Id of) const
    {
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_model_label(get(), detail::c(kind), of, buffer, capacity);
        });
    }
    Id find_label(ObjectKind kind, const std::string &label) const
    {
        return id([&](Id *out) {
            return pdn_model_find_label(get(), detail::c(kind), label.c_str(), out);
        });
    }
    ///@}

    /** @name What it holds */
    ///@{
    pdn_joint_info joint(Id joint) const
    {
        pdn_joint_info out;
        pdn_joint_info_init(&out, sizeof out);
        detail::check(pdn_model_joint(get(), joint, &out));
        return out;
    }
    pdn_force_info force(Id force) const
    {
        pdn_force_info out;
        pdn_force_info_init(&out, sizeof out);
        detail::check(pdn_model_force(get(), force, &out));
        return out;
    }
    double force_number(Id force, ForceNumber number, std::int32_t index) const
    {
        double out = 0;
        detail::check(pdn_model_force_number(get(), force, detail::c(number), index, &out));
        return out;
    }
    Id force_node(Id force, std::int32_t index) const
    {
        return id([&](Id *out) { return pdn_model_force_node(get(), force, index, out); });
    }
    std::vector<Id> beam_element_nodes(Id element) const
    {
        std::vector<Id> nodes(static_cast<std::size_t>(
            id([&](Id *out) { return pdn_model_beam_element_node_count(get(), element, out); })));
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            detail::check(pdn_model_beam_element_node(get(), element, static_cast<Id>(i), &nodes[i]));
        }
        return nodes;
    }
    /** Section and twist at a place from -1 to 1. */
    std::pair<pdn_section, double> beam_section(Id element, double station) const
    {
        std::pair<pdn_section, double> out;
        pdn_section_init(&out.first, sizeof out.first);
        detail::check(pdn_model_beam_section(get(), element, station, &out.first, &out.second));
        return out;
    }
    Id inertia_count() const
    {
        return id([&](Id *out) { return pdn_model_inertia_count(get(), out); });
    }
    /** Node and matrix of a body, mass or inertia. */
    std::pair<Id, Matrix6> inertia(Id inertia) const
    {
        std::pair<Id, Matrix6> out;
        detail::check(pdn_model_inertia(get(), inertia, &out.first, out.second.data()));
        return out;
    }
    /** The inertia of a node: of a rigid body its own. */
    Id inertia_of(Id node) const
    {
        return id([&](Id *out) { return pdn_model_inertia_of(get(), node, out); });
    }
    std::pair<Id, Coordinate> prescribed(Id prescribed) const
    {
        Id joint = 0;
        std::int32_t coordinate = 0;
        detail::check(pdn_model_prescribed(get(), prescribed, &joint, &coordinate));
        return {joint, static_cast<Coordinate>(coordinate)};
    }
    Id load_count() const
    {
        return id([&](Id *out) { return pdn_model_load_count(get(), out); });
    }
    std::pair<Id, Frame> load_at(Id load) const
    {
        Id node = 0;
        std::int32_t frame = 0;
        detail::check(pdn_model_load_at(get(), load, &node, &frame));
        return {node, static_cast<Frame>(frame)};
    }
    Id beam_load_count() const
    {
        return id([&](Id *out) { return pdn_model_beam_load_count(get(), out); });
    }
    BeamLoad beam_load(Id load) const
    {
        BeamLoad out;
        std::int32_t frame = 0, places = 0;
        detail::check(pdn_model_beam_load(get(), load, &out.first_element, &out.elements, &frame,
                                          out.axis_2.data(), &places));
        out.frame = static_cast<Frame>(frame);
        out.fractions.resize(static_cast<std::size_t>(places));
        out.factors.resize(out.fractions.size());
        for (std::int32_t i = 0; i < places; ++i) {
            const auto k = static_cast<std::size_t>(i);
            detail::check(
                pdn_model_beam_load_factor(get(), load, i, &out.fractions[k], &out.factors[k]));
        }
        return out;
    }
    Id shell_load_count() const
    {
        return id([&](Id *out) { return pdn_model_shell_load_count(get(), out); });
    }
    ShellLoad shell_load(Id load) const
    {
        ShellLoad out;
        std::int32_t place = 0, frame = 0;
        detail::check(pdn_model_shell_load(get(), load, &out.first_element, &out.elements, &place,
                                           &frame));
        out.place = static_cast<ShellPlace>(place);
        out.frame = static_cast<Frame>(frame);
        return out;
    }
    Id parameter_count() const
    {
        return id([&](Id *out) { return pdn_model_parameter_count(get(), out); });
    }
    /** Value and scale of a parameter. */
    std::pair<double, double> parameter(Id parameter) const
    {
        std::pair<double, double> out;
        detail::check(pdn_model_parameter(get(), parameter, &out.first, &out.second));
        return out;
    }
    std::string parameter_name(Id parameter) const
    {
        return detail::text([&](char *buffer, std::size_t size) {
            return pdn_model_parameter_name(get(), parameter, buffer, size);
        });
    }
    Id find_parameter(const std::string &name) const
    {
        return id([&](Id *out) { return pdn_model_find_parameter(get(), name.c_str(), out); });
    }
    std::vector<RelationTerm> relation_terms(Id relation) const
    {
        std::vector<RelationTerm> terms(static_cast<std::size_t>(
            id([&](Id *out) { return pdn_model_relation_term_count(get(), relation, out); })));
        for (std::size_t i = 0; i < terms.size(); ++i) {
            std::int32_t coordinate = 0;
            detail::check(pdn_model_relation_term(get(), relation, static_cast<Id>(i),
                                                  &terms[i].joint, &coordinate,
                                                  &terms[i].coefficient));
            terms[i].coordinate = static_cast<Coordinate>(coordinate);
        }
        return terms;
    }
    std::vector<double> sample_signal(SignalOf place, Id id, std::int32_t component, double period,
                                      Reals times) const
    {
        std::vector<double> values(times.size());
        detail::check(pdn_model_sample_signal(get(), detail::c(place), id, component, period,
                                              times.data(), times.size(), values.data()));
        return values;
    }
    ///@}

    /** @name Nodes and bodies */
    ///@{
    Id add_node(const Vector3 &position)
    {
        return id(
            [&](Id *out) { return pdn_model_add_node(get(), position.data(), nullptr, out); });
    }
    Id add_node(const Vector3 &position, const Matrix3 &rotation)
    {
        return id([&](Id *out) {
            return pdn_model_add_node(get(), position.data(), rotation.data(), out);
        });
    }
    Id add_rigid_body(double mass, const Vector3 &centre, const Matrix3 &inertia)
    {
        return id([&](Id *out) {
            return pdn_model_add_rigid_body(get(), mass, centre.data(), inertia.data(), out);
        });
    }
    /** A point mass; returns the id of its inertia. */
    Id add_mass(Id node, double mass, const Vector3 &centre)
    {
        return id([&](Id *out) {
            return pdn_model_add_mass(get(), node, mass, centre.data(), nullptr, out);
        });
    }
    Id add_mass(Id node, double mass, const Vector3 &centre, const Matrix3 &inertia)
    {
        return id([&](Id *out) {
            return pdn_model_add_mass(get(), node, mass, centre.data(), inertia.data(), out);
        });
    }
    /** About and along the node's own axes. */
    Id add_inertia(Id node, const Matrix6 &matrix)
    {
        return id([&](Id *out) {
            return pdn_model_add_inertia(get(), node, nullptr, matrix.data(), out);
        });
    }
    Id add_inertia(Id node, const pdn_frame &frame, const Matrix6 &matrix)
    {
        return id([&](Id *out) {
            return pdn_model_add_inertia(get(), node, &frame, matrix.data(), out);
        });
    }
    ///@}

    /** @name Joints */
    ///@{
    Id add_rigid_joint(Id first, Id second, const Vector3 &point)
    {
        return id([&](Id *out) {
            return pdn_model_add_rigid_joint(get(), first, second, point.data(), out);
        });
    }
    Id add_revolute(Id first, Id second, const Vector3 &point, const Vector3 &axis)
    {
        return id([&](Id *out) {
            return pdn_model_add_revolute(get(), first, second, point.data(), axis.data(), out);
        });
    }
    Id add_prismatic(Id first, Id second, const Vector3 &point, const Vector3 &axis)
    {
        return id([&](Id *out) {
            return pdn_model_add_prismatic(get(), first, second, point.data(), axis.data(), out);
        });
    }
    Id add_cylindrical(Id first, Id second, const Vector3 &point, const Vector3 &axis)
    {
        return id([&](Id *out) {
            return pdn_model_add_cylindrical(get(), first, second, point.data(), axis.data(), out);
        });
    }
    Id add_screw(Id first, Id second, const Vector3 &point, const Vector3 &axis, double pitch)
    {
        return id([&](Id *out) {
            return pdn_model_add_screw(get(), first, second, point.data(), axis.data(), pitch, out);
        });
    }
    Id add_planar(Id first, Id second, const Vector3 &point, const Vector3 &normal)
    {
        return id([&](Id *out) {
            return pdn_model_add_planar(get(), first, second, point.data(), normal.data(), out);
        });
    }
    Id add_spherical(Id first, Id second, const Vector3 &point)
    {
        return id([&](Id *out) {
            return pdn_model_add_spherical(get(), first, second, point.data(), out);
        });
    }
    Id add_universal(Id first, Id second, const Vector3 &point, const Vector3 &first_arm,
                     const Vector3 &second_arm)
    {
        return id([&](Id *out) {
            return pdn_model_add_universal(get(), first, second, point.data(), first_arm.data(),
                                           second_arm.data(), out);
        });
    }
    Id add_free_joint(Id first, Id second, const Vector3 &point)
    {
        return id([&](Id *out) {
            return pdn_model_add_free_joint(get(), first, second, point.data(), out);
        });
    }
    Id add_strut(Id first, Id second, const Vector3 &first_point, const Vector3 &second_point)
    {
        return id([&](Id *out) {
            return pdn_model_add_strut(get(), first, second, first_point.data(),
                                       second_point.data(), out);
        });
    }
    Id add_joint(JointKind kind, Id first, Id second, const pdn_frame &first_frame,
                 const pdn_frame &second_frame)
    {
        return id([&](Id *out) {
            return pdn_model_add_joint(get(), detail::c(kind), first, second, &first_frame,
                                       &second_frame, out);
        });
    }
    Id add_screw_between(Id first, Id second, const pdn_frame &first_frame,
                         const pdn_frame &second_frame, double pitch)
    {
        return id([&](Id *out) {
            return pdn_model_add_screw_between(get(), first, second, &first_frame, &second_frame,
                                               pitch, out);
        });
    }
    Id prescribe(Id joint, Coordinate coordinate, const Signal &signal)
    {
        return take({&signal}, [&](Id *out) {
            return pdn_model_prescribe(get(), joint, detail::c(coordinate), &signal.get(), out);
        });
    }
    /** The sum of coefficients times coordinates stays what it is in the reference configuration. */
    Id add_relation(Ids joints, const std::vector<Coordinate> &coordinates, Reals coefficients)
    {
        return id([&](Id *out) {
            return relation(joints, coordinates, coefficients, nullptr, out);
        });
    }
    /** The sum of coefficients times coordinates is a signal. */
    Id add_relation(Ids joints, const std::vector<Coordinate> &coordinates, Reals coefficients,
                    const Signal &signal)
    {
        return take({&signal}, [&](Id *out) {
            return relation(joints, coordinates, coefficients, &signal.get(), out);
        });
    }
    ///@}

    /** @name Beams */
    ///@{
    Id add_beam_element(Ids nodes, const Section &section)
    {
        return id([&](Id *out) {
            return pdn_model_add_beam_element(get(), nodes.data(), nodes.size(), &section, out);
        });
    }
    pdn_beam add_straight_beam(const Vector3 &start, const Vector3 &end, const Vector3 &axis_2,
                               const Section &section, std::size_t elements, std::size_t degree)
    {
        return detail::number<pdn_beam>([&](pdn_beam *out) {
            return pdn_model_add_straight_beam(get(), start.data(), end.data(), axis_2.data(),
                                               &section, elements, degree, out);
        });
    }
    pdn_beam add_beam(const Line &line, const Stations &stations, std::size_t elements,
                      std::size_t degree)
    {
        const pdn_stations along = stations.get();
        return detail::number<pdn_beam>([&](pdn_beam *out) {
            return pdn_model_add_beam(get(), &line.get(), &along, elements, degree, out);
        });
    }
    /** Elements from each of the boundaries to the next, fractions of the span. */
    pdn_beam add_beam_between(const Line &line, const Stations &stations, Reals boundaries,
                              std::size_t degree)
    {
        const pdn_stations along = stations.get();
        const std::size_t elements = boundaries.size() == 0 ? 0 : boundaries.size() - 1;
        return detail::number<pdn_beam>([&](pdn_beam *out) {
            return pdn_model_add_beam_between(get(), &line.get(), &along, boundaries.data(),
                                              elements, degree, out);
        });
    }
    ///@}

    /** @name Shells */
    ///@{
    /** Over nodes that are there: node i n_eta + j is at (xi_i, eta_j). */
    Id add_shell_element(Ids nodes, std::size_t n_xi, const ShellSection &section,
                         const ShellPlacement &placement = {})
    {
        return id([&](Id *out) {
            return pdn_model_add_shell_element(get(), nodes.data(), nodes.size(), n_xi, &section,
                                               &placement, out);
        });
    }
    /** Over a surface: `elements` and `degrees` along u and v. */
    pdn_shell add_shell(const Surface &surface, const Counts &elements, const Counts &degrees,
                        const ShellSection &section, const ShellPlacement &placement = {},
                        bool join = true)
    {
        return detail::number<pdn_shell>([&](pdn_shell *out) {
            return pdn_model_add_shell(get(), &surface.get(), elements[0], elements[1], degrees[0],
                                       degrees[1], join ? 1 : 0, &section, &placement, out);
        });
    }
    /** Over given positions of its nodes, those along v first. */
    pdn_shell add_shell_grid(const std::vector<Vector3> &points, const Counts &elements,
                             const Counts &degrees, const ShellSection &section,
                             const ShellPlacement &placement = {}, bool join = true)
    {
        return detail::number<pdn_shell>([&](pdn_shell *out) {
            return pdn_model_add_shell_grid(get(), detail::flat(points), points.size(),
                                            elements[0], elements[1], degrees[0], degrees[1],
                                            join ? 1 : 0, &section, &placement, out);
        });
    }
    /** An element for each cell of 4 or 9 points, corners first; gives the first of them. */
    Id add_shell_quadrilaterals(const std::vector<Vector3> &points, Ids cells,
                                std::size_t points_of_cell, std::size_t degree,
                                const ShellSection &section, const ShellPlacement &placement = {})
    {
        return id([&](Id *out) {
            return pdn_model_add_shell_quadrilaterals(get(), detail::flat(points), points.size(),
                                                      cells.data(), cells.size(), points_of_cell,
                                                      degree, &section, &placement, out);
        });
    }
    /** Node of a shell over a surface or a grid, numbered from 0 along u and v. */
    Id shell_node(const pdn_shell &shell, Id u, Id v) const
    {
        return id(
            [&](Id *out) { return pdn_model_shell_patch_node(get(), &shell, u, v, out); });
    }
    /** Node of a shell element, numbered from 0 along xi and eta. */
    Id shell_node(Id element, Id xi, Id eta) const
    {
        return id([&](Id *out) { return pdn_model_shell_node(get(), element, xi, eta, out); });
    }
    Id shell_element_count() const
    {
        return id([&](Id *out) { return pdn_model_shell_element_count(get(), out); });
    }
    /** Fixes nodes to a body, one of them or any other, by a rigid joint each; gives these. */
    std::vector<Id> add_rigid_joints(Id body, Ids nodes)
    {
        return rigid_joints([&](Id *first, Id *joints) {
            return pdn_model_add_rigid_joints(get(), body, nodes.data(), nodes.size(), first,
                                              joints);
        });
    }
    /** Fixes an edge of a shell over a surface or a grid to a body; gives the rigid joints. */
    std::vector<Id> add_rigid_edge(Id body, const pdn_shell &shell, ShellPlace edge)
    {
        return rigid_joints([&](Id *first, Id *joints) {
            return pdn_model_add_rigid_edge(get(), body, &shell, detail::c(edge), first, joints);
        });
    }
    /** Initial stress: forces and moments where nothing is strained, as of the section. */
    void set_shell_prestress(Id first_element, Id elements,
                             const std::array<double, 12> &resultants)
    {
        detail::check(
            pdn_model_set_shell_prestress(get(), first_element, elements, resultants.data()));
    }
    /** A component for each unit of area of the surfaces, or of length of edges. */
    Id add_shell_load(Id first_element, Id elements, ShellPlace place, Frame frame,
                      Component component, const Signal &signal)
    {
        return take({&signal}, [&](Id *out) {
            return pdn_model_add_shell_load(get(), first_element, elements, detail::c(place),
                                            detail::c(frame), detail::c(component), &signal.get(),
                                            out);
        });
    }
    ///@}

    /** @name Loads */
    ///@{
    Id add_load(Id node, Frame frame, Component component, const Signal &signal)
    {
        return take({&signal}, [&](Id *out) {
            return pdn_model_add_load(get(), node, detail::c(frame), detail::c(component),
                                      &signal.get(), out);
        });
    }
    /** The factors of the signal are linear between fractions of the length; 1 if none are given.
     */
    Id add_distributed_load(Id first_element, Id elements, Frame frame, Component component,
                            const Signal &signal, Reals fractions = {}, Reals factors = {})
    {
        if (fractions.size() != factors.size()) {
            throw error(PDN_ERR_SIZE, "factors: expected as many as fractions");
        }
        return take({&signal}, [&](Id *out) {
            return pdn_model_add_distributed_load(
                get(), first_element, elements, detail::c(frame), detail::c(component),
                &signal.get(), fractions.data(), factors.data(), fractions.size(), out);
        });
    }
    /** All components at all places: six signals for each fraction of the length, linear in between. Frame::untwisted
     * has axis 1 along the reference line, and axis 2 as near to axis_2 as it can be. Returns the id of the load at
     * the first place; the others follow. */
    Id add_load_at_places(Id first_element, Id elements, Frame frame, Reals fractions,
                          const std::vector<std::array<Signal, 6>> &signals,
                          const Vector3 &axis_2 = {})
    {
        if (fractions.size() != signals.size()) {
            throw error(PDN_ERR_SIZE, "signals: expected as many as fractions");
        }
        std::vector<const Signal *> all;
        std::vector<pdn_signal> given;
        for (const auto &place : signals) {
            for (const Signal &signal : place) {
                all.push_back(&signal);
                given.push_back(signal.get());
            }
        }
        return take(all, [&](Id *out) {
            return pdn_model_add_load_at_places(get(), first_element, elements, detail::c(frame),
                                                axis_2.data(), fractions.data(), given.data(),
                                                fractions.size(), out);
        });
    }
    /** Adds a parameter, which moves nothing yet. */
    Id add_parameter(const std::string &name, double value, double scale)
    {
        return id([&](Id *out) {
            return pdn_model_add_parameter(get(), name.c_str(), value, scale, out);
        });
    }
    /** Lets a parameter move a number of the force, inertia or element `id`. */
    void move_number(Id parameter, Number number, Id id, std::int32_t power, double factor)
    {
        detail::check(
            pdn_model_move_number(get(), parameter, detail::c(number), id, power, factor));
    }
    /** Lets a parameter move a part of the signal of what has this `id`. */
    void move_signal(Id parameter, SignalOf place, Id id, std::int32_t component, SignalPart part,
                     double factor)
    {
        detail::check(pdn_model_move_signal(get(), parameter, detail::c(place), id, component,
                                            detail::c(part), factor));
    }
    void set_parameter(Id parameter, double value)
    {
        detail::check(pdn_model_set_parameter(get(), parameter, value));
    }
    void set_mass_damping(double factor)
    {
        detail::check(pdn_model_set_mass_damping(get(), factor));
    }
    /** Declares the function of a force one of the phase, which it is then told. */
    void declare_of_phase(Id force)
    {
        detail::check(pdn_model_declare_of_phase(get(), force));
    }
    /** Describes everything in a frame that turns steadily about an axis through `point`. */
    void set_turning_frame(const Vector3 &axis, double rate, const Vector3 &point = {0, 0, 0})
    {
        detail::check(pdn_model_set_turning_frame(get(), axis.data(), rate, point.data()));
    }
    /** The frame that everything is described in, if it turns; else an Error. */
    TurningFrame turning_frame() const
    {
        TurningFrame frame{};
        detail::check(pdn_model_turning_frame(get(), frame.axis.data(), &frame.rate,
                                              frame.point.data()));
        return frame;
    }
    /** Says that `blades` blades are alike, with their nodes blade after blade; a `hub` turns with
     * them about an axis through `point`. */
    void set_rotor_symmetry(const Vector3 &axis, std::int32_t blades, Ids nodes, Ids hub,
                            const Vector3 &point = {0, 0, 0})
    {
        detail::check(pdn_model_set_rotor_symmetry(get(), axis.data(), blades, nodes.data(),
                                                   nodes.size(), hub.data(), hub.size(),
                                                   point.data()));
    }
    /** The rotor whose blades were said to be alike; else an Error. */
    RotorSymmetry rotor_symmetry() const
    {
        RotorSymmetry rotor{};
        detail::check(pdn_model_rotor_symmetry(get(), rotor.axis.data(), rotor.point.data(),
                                               &rotor.blades, &rotor.nodes_of_blade,
                                               &rotor.hub_nodes));
        return rotor;
    }
    /** A node of a blade, or of the hub, which is blade -1, of that rotor. */
    Id rotor_node(Id blade, Id index) const
    {
        Id node{};
        detail::check(pdn_model_rotor_node(get(), blade, index, &node));
        return node;
    }
    void set_gravity(const Vector3 &acceleration)
    {
        detail::check(pdn_model_set_gravity(get(), acceleration.data()));
    }
    /** Gravity that varies in time. */
    void set_gravity(const Signal &acceleration_1, const Signal &acceleration_2,
                     const Signal &acceleration_3)
    {
        take({&acceleration_1, &acceleration_2, &acceleration_3}, [&](Id *) {
            return pdn_model_set_gravity_signals(get(), &acceleration_1.get(),
                                                 &acceleration_2.get(), &acceleration_3.get());
        });
    }
    ///@}

    /** @name Forces on joint coordinates and nodes */
    ///@{
    Id add_spring_damper(Id joint, Coordinate coordinate, double stiffness, double damping = 0,
                         double rest = 0)
    {
        return id([&](Id *out) {
            return pdn_model_add_spring_damper(get(), joint, detail::c(coordinate), stiffness,
                                               damping, rest, out);
        });
    }
    Id add_nonlinear_spring_damper(Id joint, Coordinate coordinate, Reals stiffness, Reals damping,
                                   double rest = 0)
    {
        return id([&](Id *out) {
            return pdn_model_add_nonlinear_spring_damper(get(), joint, detail::c(coordinate),
                                                         stiffness.data(), stiffness.size(),
                                                         damping.data(), damping.size(), rest, out);
        });
    }
    Id add_actuator(Id joint, Coordinate coordinate, const Signal &signal)
    {
        return take({&signal}, [&](Id *out) {
            return pdn_model_add_actuator(get(), joint, detail::c(coordinate), &signal.get(), out);
        });
    }
    Id add_viscoelastic(Id joint, Coordinate coordinate, double stiffness, double rest,
                        Reals branch_stiffness, Reals relaxation_times)
    {
        if (branch_stiffness.size() != relaxation_times.size()) {
            throw error(PDN_ERR_SIZE, "relaxation_times: expected as many as branch_stiffness");
        }
        return id([&](Id *out) {
            return pdn_model_add_viscoelastic(get(), joint, detail::c(coordinate), stiffness, rest,
                                              branch_stiffness.data(), relaxation_times.data(),
                                              branch_stiffness.size(), out);
        });
    }
    /** In the second node's own frame. */
    Id add_viscous_damper(Id first, Id second, const Matrix6 &matrix)
    {
        return id([&](Id *out) {
            return pdn_model_add_viscous_damper(get(), first, second, nullptr, matrix.data(), out);
        });
    }
    Id add_viscous_damper(Id first, Id second, const pdn_frame &frame, const Matrix6 &matrix)
    {
        return id([&](Id *out) {
            return pdn_model_add_viscous_damper(get(), first, second, &frame, matrix.data(), out);
        });
    }
    /** Column by column: `stiffness[i + 6 * j]` is effort i for a unit of displacement or angle j. */
    Id add_bushing(Id first, Id second, const pdn_frame &first_frame, const pdn_frame &second_frame,
                   const Matrix6 &stiffness, const Matrix6 &damping,
                   BushingAngles angles = BushingAngles::rotation_vector)
    {
        return id([&](Id *out) {
            return pdn_model_add_bushing(get(), first, second, &first_frame, &second_frame,
                                         stiffness.data(), damping.data(), detail::c(angles), out);
        });
    }
    /** A law double(time, coordinate, rate), or Effort(time, coordinate, rate) with derivatives. */
    template <class Law> Id add_coordinate_law(Id joint, Coordinate coordinate, Law law)
    {
        using Result = std::invoke_result_t<Law &, double, double, double>;
        constexpr bool given = std::is_convertible_v<Result, Effort>;
        const auto tangents = given ? Tangents::given : Tangents::differenced;
        Id force = 0;
        detail::hand_over(std::move(law), [&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_add_coordinate_law(get(), joint, detail::c(coordinate),
                                                detail::c(tangents), &evaluate_law<Law>, owned,
                                                destroy, &force);
        });
        return force;
    }
    /** Forces void(const ForceState &, ForceValues &). */
    template <class Forces>
    Id add_user_force(Ids nodes, Frame frame, Tangents tangents, Forces forces)
    {
        Id force = 0;
        detail::hand_over(std::move(forces), [&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_add_user_force(get(), nodes.data(), nodes.size(), detail::c(frame),
                                            detail::c(tangents), &evaluate_forces<Forces>, owned,
                                            destroy, &force);
        });
        return force;
    }
    /** Efforts by a law void(const ControllerState &, ControllerValues &) of coordinates, their
        rates, and states: of as many as `initial` has, or `sizes`. */
    template <class Law>
    Id add_controller(Ids input_joints, const std::vector<Coordinate> &input_coordinates,
                      Ids output_joints, const std::vector<Coordinate> &output_coordinates,
                      Reals initial, Reals sizes, Tangents tangents, Law law)
    {
        const std::vector<std::int32_t> read = codes(input_coordinates, input_joints);
        const std::vector<std::int32_t> acted = codes(output_coordinates, output_joints);
        if (initial.size() != sizes.size() && initial.size() != 0 && sizes.size() != 0) {
            throw error(PDN_ERR_SIZE, "sizes: expected as many as initial");
        }
        const std::size_t states = initial.size() == 0 ? sizes.size() : initial.size();
        Id force = 0;
        detail::hand_over(std::move(law), [&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_add_controller(
                get(), input_joints.data(), read.data(), read.size(), output_joints.data(),
                acted.data(), acted.size(), initial.size() == 0 ? nullptr : initial.data(),
                sizes.size() == 0 ? nullptr : sizes.data(), states, detail::c(tangents),
                &evaluate_controller<Law>, owned, destroy, &force);
        });
        return force;
    }
    /** Gives a controller its function, or another: that of a file is not there. */
    template <class Law> void bind_controller(Id force, Tangents tangents, Law law)
    {
        detail::hand_over(std::move(law), [&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_bind_controller(get(), force, detail::c(tangents),
                                             &evaluate_controller<Law>, owned, destroy);
        });
    }
    /** Numbers of the coordinates that a controller reads, acts on, and of its states. */
    std::array<Id, 3> controller_counts(Id force) const
    {
        std::array<Id, 3> out{};
        detail::check(pdn_model_controller_counts(get(), force, &out[0], &out[1], &out[2]));
        return out;
    }
    /** Joint and coordinate that a controller reads or, counted on, acts on. */
    std::pair<Id, Coordinate> controller_coordinate(Id force, Id index) const
    {
        Id joint = 0, coordinate = 0;
        detail::check(
            pdn_model_controller_coordinate(get(), force, index, &joint, &coordinate));
        return {joint, static_cast<Coordinate>(coordinate)};
    }
    /** Where a state begins in a march, and its size. */
    std::pair<double, double> controller_state(Id force, Id index) const
    {
        double initial = 0.0, size = 0.0;
        detail::check(pdn_model_controller_state(get(), force, index, &initial, &size));
        return {initial, size};
    }
    /** Forces void(const SurfaceState &, SurfaceValues &) on shell elements; gives the first. */
    template <class Forces>
    Id add_surface_force(Id first_element, Id elements, ShellPlace place, Frame frame,
                         Tangents tangents, Forces forces)
    {
        Id first = 0;
        detail::hand_over(std::move(forces), [&](void *owned, pdn_destroy_fn destroy) {
            return pdn_model_add_surface_force(get(), first_element, elements, detail::c(place),
                                               detail::c(frame), detail::c(tangents),
                                               &evaluate_surface<Forces>, owned, destroy, &first);
        });
        return first;
    }
    /** Compares the tangents that a law or user's force gives with differences. */
    pdn_tangent_check check_tangents(Id force, double period) const
    {
        pdn_tangent_check out;
        pdn_tangent_check_init(&out, sizeof out);
        detail::check(pdn_model_check_tangents(get(), force, period, &out));
        return out;
    }
    ///@}

  private:
    template <class Add> static Id id(Add add)
    {
        return detail::number<Id>(add);
    }
    static std::vector<std::int32_t> codes(const std::vector<Coordinate> &coordinates, Ids joints)
    {
        if (joints.size() != coordinates.size()) {
            throw error(PDN_ERR_SIZE, "coordinates: expected as many as joints");
        }
        std::vector<std::int32_t> which;
        for (const Coordinate coordinate : coordinates) {
            which.push_back(detail::c(coordinate));
        }
        return which;
    }
    template <class Add> static std::vector<Id> rigid_joints(Add add)
    {
        Id first = 0, count = 0;
        detail::check(add(&first, &count));
        std::vector<Id> all;
        for (Id k = 0; k < count; ++k) {
            all.push_back(first + k);
        }
        return all;
    }
    pdn_status relation(Ids joints, const std::vector<Coordinate> &coordinates, Reals coefficients,
                        const pdn_signal *signal, Id *out)
    {
        if (joints.size() != coordinates.size() || joints.size() != coefficients.size()) {
            throw error(PDN_ERR_SIZE, "coefficients: expected as many as joints and coordinates");
        }
        const std::vector<std::int32_t> which = codes(coordinates, joints);
        return pdn_model_add_relation(get(), joints.data(), which.data(), coefficients.data(),
                                      joints.size(), signal, out);
    }
    /** Calls what takes the signals, and keeps what they point to; returns the id of what is added. */
    template <class Call> Id take(const std::vector<const Signal *> &signals, Call call)
    {
        Id added = 0;
        const std::size_t before = kept_.size();
        for (const Signal *signal : signals) {
            const std::int32_t kind = signal->get().kind;
            if (kind == PDN_SIGNAL_FUNCTION || kind == PDN_SIGNAL_FUNCTION_OF_PHASE) {
                kept_.push_back(signal->kept());
            }
        }
        const pdn_status status = call(&added);
        if (status != PDN_OK) {
            kept_.resize(before);
        }
        detail::check(status);
        return added;
    }
    template <class Law>
    static std::int32_t evaluate_law(double time, double coordinate, double rate, double *effort,
                                     double *derivatives, void *law) noexcept
    {
        return detail::guarded([=] {
            const auto result = (*static_cast<Law *>(law))(time, coordinate, rate);
            if constexpr (std::is_convertible_v<decltype(result), Effort>) {
                const Effort &given = result;
                *effort = given.effort;
                if (derivatives != nullptr) {
                    derivatives[0] = given.by_coordinate;
                    derivatives[1] = given.by_rate;
                }
            } else {
                *effort = result;
            }
            static_cast<void>(derivatives);
        });
    }
    template <class Forces>
    static std::int32_t evaluate_forces(const pdn_force_state *state, pdn_force_values *values,
                                        void *forces) noexcept
    {
        return detail::guarded([=] {
            const ForceState motions(*state);
            ForceValues out(state->node_count, *values);
            (*static_cast<Forces *>(forces))(motions, out);
        });
    }
    template <class Forces>
    static std::int32_t evaluate_surface(const pdn_surface_state *state, pdn_surface_values *values,
                                         void *forces) noexcept
    {
        return detail::guarded([=] {
            const SurfaceState points(*state);
            SurfaceValues out(state->point_count, *values);
            (*static_cast<Forces *>(forces))(points, out);
        });
    }

    template <class Law>
    static std::int32_t evaluate_controller(const pdn_controller_state *state,
                                            pdn_controller_values *values, void *law) noexcept
    {
        return detail::guarded([=] {
            const ControllerState read(*state);
            ControllerValues out(read, *values);
            (*static_cast<Law *>(law))(read, out);
        });
    }

    detail::Kept kept_; // outlives the handle
    std::unique_ptr<pdn_model, detail::Free> handle_;
};

/** Fourier coefficients: mean + rate t + sum of cosines[j-1] cos(j w t) + sines[j-1] sin(j w t). */
struct Harmonics {
    std::size_t components = 0;
    /** One for each component. */
    std::vector<double> mean, rate;
    /** Components of each harmonic together. */
    std::vector<double> cosines, sines;
};

/** What is asked of a solution, with the fields of ::pdn_quantity; `component` is PDN_ALL_COMPONENTS
 * at first. */
struct Quantity : pdn_quantity {
    /** Of a node, joint, beam element, shell element or force. */
    Quantity(Kind of_kind, std::int32_t of_object)
    {
        pdn_quantity_init(this, sizeof(pdn_quantity));
        kind = detail::c(of_kind);
        object = of_object;
    }
    /** A coordinate of a joint, its rate or acceleration, or what drives it. */
    Quantity(Kind of_kind, std::int32_t joint, Coordinate coordinate) : Quantity(of_kind, joint)
    {
        component = detail::c(coordinate);
    }
    /** Of a shell, at (xi, eta); a direction of zero stands for the axes of its section. */
    Quantity(Kind of_kind, std::int32_t shell_element, const std::array<double, 2> &at,
             const Vector3 &axis_1 = {})
        : Quantity(of_kind, shell_element)
    {
        station = at[0];
        station_eta = at[1];
        for (std::size_t i = 0; i < 3; ++i) {
            direction[i] = axis_1[i];
        }
    }
    /** Along other axes: of velocities, accelerations and what a force exerts on a node. */
    Quantity in(Frame of_motion) const
    {
        Quantity other(*this);
        other.frame = detail::c(of_motion);
        return other;
    }
    /** Along other axes: of reactions. */
    Quantity in(Axes of_reaction) const
    {
        Quantity other(*this);
        other.frame = detail::c(of_reaction);
        return other;
    }
    /** At a place along a beam element, from -1 to 1. */
    Quantity at(double along) const
    {
        Quantity other(*this);
        other.station = along;
        return other;
    }
    /** On this node: of what a force exerts. */
    Quantity on(std::int32_t of_node) const
    {
        Quantity other(*this);
        other.node = of_node;
        return other;
    }
    /** Of this branch of a viscoelastic element; of controllers, of this coordinate or state. */
    Quantity of_branch(std::int32_t which) const
    {
        Quantity other(*this);
        other.branch = which;
        return other;
    }
    /** Whether all components are asked for. */
    bool is_whole() const noexcept
    {
        return component == PDN_ALL_COMPONENTS;
    }
    /** Number of components that are asked for. */
    std::size_t components() const
    {
        const std::int32_t count = pdn_quantity_components(this);
        detail::check(count);
        return static_cast<std::size_t>(count);
    }
};

/** Smallest and largest values of each component, and their times. */
struct Extremes {
    std::vector<double> smallest, time_of_smallest, largest, time_of_largest;
};

/** Newton iterations of the periodic problem. */
struct History {
    std::vector<double> residuals, increments, steps;
};

/** A solution, converged or not. */
class Solution
{
  public:
    using Id = std::int32_t;

    /** Takes over a handle of periodyn.h; keeps the functions of signals that it may call. */
    explicit Solution(pdn_solution *handle, detail::Kept kept = {})
        : kept_(std::move(kept)), handle_(handle)
    {
    }
    /** The handle, for functions of periodyn.h; NULL if moved from. */
    const pdn_solution *get() const noexcept
    {
        return handle_.get();
    }

    /** @name The solve */
    ///@{
    Outcome outcome() const
    {
        const std::int32_t outcome = pdn_solution_outcome(get());
        detail::check(outcome);
        return static_cast<Outcome>(outcome);
    }
    bool converged() const
    {
        return outcome() == Outcome::converged;
    }
    std::string report() const
    {
        outcome(); // throws if there is nothing to report
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_solution_report(get(), buffer, capacity);
        });
    }
    /** A copy whose quantities are seen through a spectral filter. */
    Solution filtered(Filter filter, std::int32_t order) const
    {
        auto handle = detail::make<pdn_solution>([&](pdn_solution **out) {
            return pdn_solution_filtered(get(), static_cast<std::int32_t>(filter), order, out);
        });
        return Solution(handle.release(), kept_);
    }
    /** Value of a parameter, or of the frequency. */
    double parameter(std::int32_t parameter) const
    {
        return detail::number<double>(
            [&](double *out) { return pdn_solution_parameter(get(), parameter, out); });
    }
    pdn_diagnostics diagnostics() const
    {
        pdn_diagnostics out;
        pdn_diagnostics_init(&out, sizeof out);
        detail::check(pdn_solution_diagnostics(get(), &out));
        return out;
    }
    /** Figures of a march. */
    pdn_march_diagnostics march() const
    {
        pdn_march_diagnostics out;
        pdn_march_diagnostics_init(&out, sizeof out);
        detail::check(pdn_solution_march(get(), &out));
        return out;
    }
    /** Floquet multipliers of a solution by solve_shooting, the largest first. */
    std::vector<std::complex<double>> floquet() const
    {
        std::size_t count = 0;
        detail::check(pdn_solution_floquet_count(get(), &count));
        std::vector<double> real(count), imaginary(count);
        detail::check(pdn_solution_floquet(get(), real.data(), imaginary.data(), count));
        std::vector<std::complex<double>> out(count);
        for (std::size_t i = 0; i < count; ++i) {
            out[i] = {real[i], imaginary[i]};
        }
        return out;
    }
    History history() const
    {
        const auto count = static_cast<std::size_t>(diagnostics().iterations);
        History out;
        out.residuals.resize(count);
        out.increments.resize(count);
        out.steps.resize(count);
        detail::check(pdn_solution_history(get(), out.residuals.data(), out.increments.data(),
                                           out.steps.data(), count));
        return out;
    }
    /** Largest amplitude of each harmonic, from 0 on. */
    std::vector<double> decay() const
    {
        std::vector<double> out((diagnostics().grid_points + 1) / 2);
        detail::check(pdn_solution_decay(get(), out.data(), out.size()));
        return out;
    }
    /** Times, widths and shares of the events that grid points are closer together about. */
    std::array<std::vector<double>, 3> sharp_events() const
    {
        std::size_t count = 0;
        detail::check(pdn_solution_sharp_event_count(get(), &count));
        std::array<std::vector<double>, 3> out;
        out.fill(std::vector<double>(count));
        detail::check(pdn_solution_sharp_events(get(), out[0].data(), out[1].data(), out[2].data(),
                                                count));
        return out;
    }
    std::vector<double> grid_times() const
    {
        std::vector<double> out(diagnostics().grid_points);
        detail::check(pdn_solution_grid_times(get(), out.data(), out.size()));
        return out;
    }
    ///@}

    /** @name Quantities */
    ///@{
    /** Values of a quantity at any times, components of each time together. */
    std::vector<double> sample(const Quantity &quantity, Reals times) const
    {
        std::vector<double> out(quantity.components() * times.size());
        detail::check(
            pdn_solution_sample(get(), &quantity, times.data(), times.size(), out.data()));
        return out;
    }
    /** Values of a quantity of C components: an array for each time. */
    template <std::size_t C> Series<C> sample(const Quantity &quantity, Reals times) const
    {
        const std::size_t components = quantity.components();
        if (components != C) {
            throw error(PDN_ERR_SIZE, "quantity: expected one of " + std::to_string(C) +
                                          " components, got " + std::to_string(components));
        }
        Series<C> out(times.size());
        detail::check(
            pdn_solution_sample(get(), &quantity, times.data(), times.size(), detail::flat(out)));
        return out;
    }
    /** Fourier coefficients of a quantity. */
    Harmonics harmonics(const Quantity &quantity, std::size_t harmonics) const
    {
        // Refuses too many before there is memory for them.
        detail::check(pdn_solution_harmonics(get(), &quantity, harmonics, nullptr, nullptr, nullptr,
                                             nullptr));
        Harmonics out;
        out.components = quantity.components();
        out.mean.resize(out.components);
        out.rate.resize(out.components);
        out.cosines.resize(out.components * harmonics);
        out.sines.resize(out.components * harmonics);
        detail::check(pdn_solution_harmonics(get(), &quantity, harmonics, out.mean.data(),
                                             out.rate.data(), out.cosines.data(),
                                             out.sines.data()));
        return out;
    }
    /** Smallest and largest values of a quantity. */
    Extremes extremes(const Quantity &quantity) const
    {
        const std::vector<double> zero(quantity.components());
        Extremes out{zero, zero, zero, zero};
        detail::check(pdn_solution_extremes(get(), &quantity, out.smallest.data(),
                                            out.time_of_smallest.data(), out.largest.data(),
                                            out.time_of_largest.data()));
        return out;
    }
    ///@}

    /** Writes an animation for ParaView; the path ends in `.pvd`. */
    void write_vtk(Reals times, std::size_t points_per_element, const std::string &path) const
    {
        detail::check(pdn_solution_write_vtk(get(), times.data(), times.size(), points_per_element,
                                             path.c_str()));
    }

    /** Saves the solution with its model, for load. */
    void save(const std::string &path) const
    {
        detail::check(pdn_solution_save(get(), path.c_str()));
    }
    static Solution load(const std::string &path)
    {
        return Solution(detail::make<pdn_solution>([&](pdn_solution **out) {
                            return pdn_solution_load(path.c_str(), out);
                        }).release());
    }
    /** A copy of the model, as it was when it was solved. */
    Model model() const
    {
        auto handle = detail::make<pdn_model>(
            [&](pdn_model **out) { return pdn_solution_model(get(), out); });
        return Model(handle.release(), kept_);
    }

  private:
    detail::Kept kept_; // outlives the handle
    std::unique_ptr<pdn_solution, detail::Free> handle_;
};

/** Told of each iteration, and now and then while one lasts: true to go on, false to cancel. */
using Progress = std::function<bool(const pdn_progress &)>;

/** Options of solve_periodic, with the fields of ::pdn_periodic_options and these in place of
 * pointers. */
struct PeriodicOptions : pdn_periodic_options {
    PeriodicOptions()
    {
        pdn_periodic_options_init(this, sizeof(pdn_periodic_options));
    }
    /** Start from this solution. */
    const Solution *initial = nullptr;
    /** Start from these motions: grid points of each node together. */
    Series<3> guess_positions;
    Series<9> guess_rotations;
    Progress progress;
};

/** Options of solve_static, with the fields of ::pdn_static_options and these in place of pointers.
 */
struct StaticOptions : pdn_static_options {
    StaticOptions()
    {
        pdn_static_options_init(this, sizeof(pdn_static_options));
    }
    /** Start from this solution. */
    const Solution *initial = nullptr;
    Progress progress;
};

namespace detail
{

/** Calls Progress for the library, and keeps what it throws. */
class Watch
{
  public:
    /** Points options of the library to it. */
    template <class Options> Watch(const Progress &progress, Options &options) : progress_(progress)
    {
        if (progress) {
            options.progress = &tell;
            options.progress_data = this;
        }
    }
    void rethrow() const
    {
        if (thrown_) {
            std::rethrow_exception(thrown_);
        }
    }

  private:
    static std::int32_t tell(const pdn_progress *progress, void *watch) noexcept
    {
        auto &self = *static_cast<Watch *>(watch);
        try {
            return self.progress_(*progress) ? 0 : 1;
        } catch (...) {
            self.thrown_ = std::current_exception();
            return 1;
        }
    }

    const Progress &progress_;
    std::exception_ptr thrown_;
};

inline const pdn_solution *initial(const Solution *solution)
{
    if (solution != nullptr && solution->get() == nullptr) {
        throw error(PDN_ERR_NULL,
                    "options.initial: expected a solution, got one that was moved from");
    }
    return solution != nullptr ? solution->get() : nullptr;
}

} // namespace detail

namespace detail
{

/** Options as the library takes them, but for progress. */
inline pdn_periodic_options plain(const Model &model, const PeriodicOptions &options)
{
    pdn_periodic_options plain = options;
    plain.initial = initial(options.initial);
    if (!options.guess_positions.empty() || !options.guess_rotations.empty()) {
        const std::size_t points =
            options.harmonics != 0 ? 2 * options.harmonics + 1 : options.grid_points;
        const std::size_t motions = points * static_cast<std::size_t>(model.node_count());
        if (options.guess_positions.size() != motions ||
            options.guess_rotations.size() != motions) {
            throw error(
                PDN_ERR_SIZE,
                "options.guess: expected positions and rotations for each grid point and node");
        }
        plain.guess_positions = flat(options.guess_positions);
        plain.guess_rotations = flat(options.guess_rotations);
    }
    return plain;
}

} // namespace detail

/** Finds the periodic response directly; whether it converged is told by Solution::outcome. */
inline Solution solve_periodic(const Model &model, double period,
                               const PeriodicOptions &options = {})
{
    pdn_periodic_options plain = detail::plain(model, options);
    detail::Watch watch(options.progress, plain);
    auto handle = detail::make<pdn_solution>(
        [&](pdn_solution **out) { return pdn_solve_periodic(model.get(), period, &plain, out); });
    watch.rethrow();
    return Solution(handle.release(), model.kept());
}

/** Free parameters, and as many conditions that determine them. */
class Conditions
{
  public:
    Conditions()
        : handle_(detail::make<pdn_conditions>(
              [](pdn_conditions **out) { return pdn_conditions_new(out); }))
    {
    }
    /** The handle, for functions of periodyn.h; NULL if moved from. */
    pdn_conditions *get() const noexcept
    {
        return handle_.get();
    }
    /** Makes a parameter, or the frequency, free. */
    void release(std::int32_t parameter)
    {
        detail::check(pdn_conditions_release(get(), parameter));
    }
    void add_phase()
    {
        detail::check(pdn_conditions_add_phase(get()));
    }
    /** That it is not turned about an axis through `point` from what the solve starts from. */
    void add_rotation_phase(const Vector3 &axis, const Vector3 &point = {0, 0, 0})
    {
        detail::check(pdn_conditions_add_rotation_phase(get(), axis.data(), point.data()));
    }
    /** That it is not moved in a direction from what the solve starts from. */
    void add_translation_phase(const Vector3 &direction)
    {
        detail::check(pdn_conditions_add_translation_phase(get(), direction.data()));
    }
    /** A joint coordinate at the start of the period. */
    void add_joint_coordinate(std::int32_t joint, Coordinate coordinate, double value)
    {
        detail::check(
            pdn_conditions_add_joint_coordinate(get(), joint, detail::c(coordinate), value));
    }
    /** A feature of one component of a quantity; `at` is the number of a harmonic, or a time. */
    void add_quantity(const Quantity &quantity, Feature feature, double at, double value,
                      double scale = 0)
    {
        detail::check(pdn_conditions_add_quantity(get(), &quantity, detail::c(feature), at, value,
                                                  scale));
    }
    void add_energy(double energy)
    {
        detail::check(pdn_conditions_add_energy(get(), energy));
    }
    /** The mean momentum in a direction, in the inertial frame. */
    void add_momentum(const Vector3 &direction, double momentum)
    {
        detail::check(pdn_conditions_add_momentum(get(), direction.data(), momentum));
    }
    /** The mean angular momentum about an axis through `point`, in the inertial frame. */
    void add_angular_momentum(const Vector3 &axis, double momentum,
                              const Vector3 &point = {0, 0, 0})
    {
        detail::check(pdn_conditions_add_angular_momentum(get(), axis.data(), point.data(),
                                                          momentum));
    }

  private:
    std::unique_ptr<pdn_conditions, detail::Free> handle_;
};

/** Finds a periodic response that meets conditions, and as many free parameters. */
inline Solution solve_conditioned(const Model &model, double period, const Conditions &conditions,
                                  const PeriodicOptions &options = {})
{
    pdn_periodic_options plain = detail::plain(model, options);
    detail::Watch watch(options.progress, plain);
    auto handle = detail::make<pdn_solution>([&](pdn_solution **out) {
        return pdn_solve_conditioned(model.get(), period, conditions.get(), &plain, out);
    });
    watch.rethrow();
    return Solution(handle.release(), model.kept());
}

/** Options of Sensitivities::of, with the fields of ::pdn_sensitivity_options. */
struct SensitivityOptions : pdn_sensitivity_options {
    SensitivityOptions(SensitivityMethod how = SensitivityMethod::automatic)
    {
        pdn_sensitivity_options_init(this, sizeof(pdn_sensitivity_options));
        this->method = detail::c(how);
    }
};

class Stability;

/** What is differentiated, by what: rows and columns of derivatives. */
class Sensitivities
{
  public:
    Sensitivities()
        : handle_(detail::make<pdn_sensitivities>(
              [](pdn_sensitivities **out) { return pdn_sensitivities_new(out); }))
    {
    }
    /** The handle, for functions of periodyn.h; NULL if moved from. */
    pdn_sensitivities *get() const noexcept
    {
        return handle_.get();
    }
    /** A feature of one component of a quantity; `at` is the number of a harmonic, or a time. */
    void add_quantity(const Quantity &quantity, Feature feature, double at = 0)
    {
        detail::check(pdn_sensitivities_add_quantity(get(), &quantity, detail::c(feature), at));
        ++dependents_;
    }
    /** The value of a free parameter, or of the frequency. */
    void add_found(std::int32_t parameter)
    {
        detail::check(pdn_sensitivities_add_found(get(), parameter));
        ++dependents_;
    }
    /** A parameter, or the frequency, that all is differentiated by. */
    void add_parameter(std::int32_t parameter)
    {
        detail::check(pdn_sensitivities_add_parameter(get(), parameter));
        ++parameters_;
    }
    /** Derivatives at a solution, where free parameters follow conditions: those by a parameter
     * together. */
    std::vector<double> of(const Solution &solution, const Conditions *conditions = nullptr,
                           const SensitivityOptions &options = {}) const
    {
        std::vector<double> derivatives(dependents_ * parameters_);
        detail::check(pdn_solution_sensitivities(
            solution.get(), get(), conditions ? conditions->get() : nullptr, &options,
            derivatives.data(), dependents_, parameters_));
        return derivatives;
    }

    /** Derivatives of a Floquet multiplier of a solution by the parameters. */
    std::vector<std::complex<double>> of_multiplier(const Solution &solution,
                                                    const Stability &stability,
                                                    std::int32_t number,
                                                    const Conditions *conditions = nullptr,
                                                    const SensitivityOptions &options = {}) const;

  private:
    std::unique_ptr<pdn_sensitivities, detail::Free> handle_;
    std::size_t dependents_ = 0, parameters_ = 0;
};

/** Options of follow_branch, with the fields of ::pdn_branch_options and these in place of pointers.
 */
struct BranchOptions : pdn_branch_options {
    BranchOptions()
    {
        pdn_branch_options_init(this, sizeof(pdn_branch_options));
    }
    /** Grid, and where the first solve starts. */
    PeriodicOptions periodic;
    /** What else is free. */
    const Conditions *conditions = nullptr;
};

/** Periodic motions along a parameter: points counted from 0. */
class Branch
{
  public:
    /** Takes over a handle of periodyn.h; keeps the functions that it may call. */
    explicit Branch(pdn_branch *handle, detail::Kept kept = {})
        : kept_(std::move(kept)), handle_(handle)
    {
    }
    /** The handle, for functions of periodyn.h; NULL if moved from. */
    const pdn_branch *get() const noexcept
    {
        return handle_.get();
    }
    BranchEnd end() const
    {
        const std::int32_t end = pdn_branch_end(get());
        detail::check(end);
        return static_cast<BranchEnd>(end);
    }
    std::string report() const
    {
        end(); // throws if there is nothing to report
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_branch_report(get(), buffer, capacity);
        });
    }
    std::int32_t count() const
    {
        return detail::number<std::int32_t>(
            [&](std::int32_t *out) { return pdn_branch_count(get(), out); });
    }
    pdn_branch_point point(std::int32_t point) const
    {
        pdn_branch_point out;
        pdn_branch_point_init(&out, sizeof out);
        detail::check(pdn_branch_get(get(), point, &out));
        return out;
    }
    Solution solution(std::int32_t point) const
    {
        auto handle = detail::make<pdn_solution>(
            [&](pdn_solution **out) { return pdn_branch_solution(get(), point, out); });
        return Solution(handle.release(), kept_);
    }
    /** With the mean, the first harmonic and the extremes of each component of quantities. */
    void write_csv(const std::string &path, const std::vector<Quantity> &quantities = {}) const
    {
        const std::vector<pdn_quantity> plain(quantities.begin(), quantities.end());
        detail::check(pdn_branch_write_csv(get(), plain.data(), plain.size(), path.c_str()));
    }
    /** Exponents along the branch, with what moves in them; blades are a node of each of the equal
     * parts of a rotor, one after the other around it. */
    void write_campbell(const std::string &path, const std::vector<std::int32_t> &blades = {},
                        const pdn_stability_options *options = nullptr) const
    {
        detail::check(pdn_branch_write_campbell(get(), options, blades.data(), blades.size(),
                                                path.c_str()));
    }
    /** Saves the branch with its model, for load. */
    void save(const std::string &path) const
    {
        detail::check(pdn_branch_save(get(), path.c_str()));
    }
    static Branch load(const std::string &path)
    {
        auto handle = detail::make<pdn_branch>(
            [&](pdn_branch **out) { return pdn_branch_load(path.c_str(), out); });
        return Branch(handle.release());
    }
    /** What of the caller's it keeps. */
    const detail::Kept &kept() const noexcept
    {
        return kept_;
    }

  private:
    detail::Kept kept_; // outlives the handle
    std::unique_ptr<pdn_branch, detail::Free> handle_;
};

namespace detail
{

template <class Follow>
Branch follow(pdn_periodic_options periodic, const Kept &kept, const BranchOptions &options,
              Follow function)
{
    Watch watch(options.periodic.progress, periodic);
    pdn_branch_options chosen = options;
    chosen.periodic = &periodic;
    chosen.conditions = options.conditions ? options.conditions->get() : nullptr;
    auto handle = make<pdn_branch>([&](pdn_branch **out) { return function(&chosen, out); });
    watch.rethrow();
    return Branch(handle.release(), kept);
}

template <class Follow>
Branch follow(const Model &model, const BranchOptions &options, Follow function)
{
    return follow(plain(model, options.periodic), model.kept(), options, function);
}

template <class Follow>
Branch follow(const Branch &branch, const BranchOptions &options, Follow function)
{
    return follow(options.periodic, branch.kept(), options, function);
}

} // namespace detail

/** Follows periodic motions along a parameter, or the frequency, through folds. */
inline Branch follow_branch(const Model &model, double period, std::int32_t parameter,
                            const BranchOptions &options)
{
    return detail::follow(model, options, [&](const pdn_branch_options *chosen, pdn_branch **out) {
        return pdn_follow_branch(model.get(), period, parameter, chosen, out);
    });
}

/** Finds the response over a range of circular frequencies, through folds. */
inline Branch solve_frequency_response(const Model &model, double first, double last,
                                       const BranchOptions &options = {})
{
    return detail::follow(model, options, [&](const pdn_branch_options *chosen, pdn_branch **out) {
        return pdn_solve_frequency_response(model.get(), first, last, chosen, out);
    });
}

/** Follows the other branch from a branch point or a period doubling on; where solves start is not
 * used. */
inline Branch switch_branch(const Branch &branch, std::int32_t point, double amplitude,
                            const BranchOptions &options)
{
    return detail::follow(branch, options, [&](const pdn_branch_options *chosen, pdn_branch **out) {
        return pdn_switch_branch(branch.get(), point, amplitude, chosen, out);
    });
}

/** Follows folds, period doublings or torus points along a second parameter, from one of them on. */
inline Branch follow_locus(const Branch &branch, std::int32_t point, std::int32_t parameter,
                           const BranchOptions &options)
{
    return detail::follow(branch, options, [&](const pdn_branch_options *chosen, pdn_branch **out) {
        return pdn_follow_locus(branch.get(), point, parameter, chosen, out);
    });
}

/** Follows a branch on from its last point; what is returned has all points. */
inline Branch continue_branch(const Branch &branch, const BranchOptions &options)
{
    return detail::follow(branch, options, [&](const pdn_branch_options *chosen, pdn_branch **out) {
        return pdn_continue_branch(branch.get(), chosen, out);
    });
}

/** Finds an equilibrium at one time, at rest or in steady rotation. */
inline Solution solve_static(const Model &model, const StaticOptions &options = {})
{
    pdn_static_options plain = options;
    plain.initial = detail::initial(options.initial);
    detail::Watch watch(options.progress, plain);
    auto handle = detail::make<pdn_solution>(
        [&](pdn_solution **out) { return pdn_solve_static(model.get(), &plain, out); });
    watch.rethrow();
    return Solution(handle.release(), model.kept());
}

/** Options of march, with the fields of ::pdn_march_options and these in place of pointers. */
struct MarchOptions : pdn_march_options {
    MarchOptions()
    {
        pdn_march_options_init(this, sizeof(pdn_march_options));
    }
    /** Start from this solution. */
    const Solution *initial = nullptr;
    /** Start from these motions and velocities of the nodes. */
    Series<3> positions;
    Series<9> rotations;
    Series<6> velocities;
    Progress progress;
};

/** Marches a model in time; the solution is a trajectory. */
inline Solution march(const Model &model, const MarchOptions &options)
{
    pdn_march_options plain = options;
    plain.initial = detail::initial(options.initial);
    const auto nodes = static_cast<std::size_t>(model.node_count());
    for (const std::size_t given :
         {options.positions.size(), options.rotations.size(), options.velocities.size()}) {
        if (given != 0 && given != nodes) {
            throw error(PDN_ERR_SIZE,
                        "options: expected positions, rotations, velocities of all nodes");
        }
    }
    plain.positions = options.positions.empty() ? nullptr : detail::flat(options.positions);
    plain.rotations = options.rotations.empty() ? nullptr : detail::flat(options.rotations);
    plain.velocities = options.velocities.empty() ? nullptr : detail::flat(options.velocities);
    detail::Watch watch(options.progress, plain);
    auto handle = detail::make<pdn_solution>(
        [&](pdn_solution **out) { return pdn_march(model.get(), &plain, out); });
    watch.rethrow();
    return Solution(handle.release(), model.kept());
}

/** Options of Equations, with the fields of ::pdn_equations_options and these in place of pointers.
 * The functions by which ranks tell each other numbers are plain ones, see ::pdn_exchange_fn. */
struct EquationsOptions : pdn_equations_options {
    EquationsOptions()
    {
        pdn_equations_options_init(this, sizeof(pdn_equations_options));
    }
    /** Start from this solution. */
    const Solution *initial = nullptr;
    /** Rank of each node; none for runs of nodes with about the same work. */
    std::vector<std::int32_t> owners;
};

/** The equations of a periodic motion below the solve, for solvers of your own; see
 * ::pdn_equations. Vectors are of the length sizes().size. */
class Equations
{
  public:
    Equations(const Model &model, double period, const EquationsOptions &options)
        : kept_(model.kept())
    {
        pdn_equations_options plain = options;
        plain.initial = detail::initial(options.initial);
        plain.owners = options.owners.empty() ? nullptr : options.owners.data();
        plain.owner_count = options.owners.size();
        handle_ = detail::make<pdn_equations>([&](pdn_equations **out) {
            return pdn_equations_new(model.get(), period, &plain, out);
        });
    }
    /** The handle, for functions of periodyn.h; NULL if moved from. */
    pdn_equations *get() const noexcept
    {
        return handle_.get();
    }
    pdn_equations_sizes sizes() const
    {
        pdn_equations_sizes sizes;
        pdn_equations_sizes_init(&sizes, sizeof sizes);
        detail::check(pdn_equations_get_sizes(get(), &sizes));
        return sizes;
    }
    /** Nodes of this rank. */
    std::vector<std::int32_t> nodes() const
    {
        std::vector<std::int32_t> nodes(sizes().nodes);
        detail::check(pdn_equations_nodes(get(), nodes.data(), nodes.size()));
        return nodes;
    }
    /** Numbers of this rank's unknowns among those of all. */
    std::vector<std::size_t> numbers() const
    {
        std::vector<std::size_t> numbers(sizes().size);
        detail::check(pdn_equations_numbers(get(), numbers.data(), numbers.size()));
        return numbers;
    }
    /** Motions and own unknowns, as ::pdn_equations_state gives them. */
    std::pair<std::vector<double>, std::vector<double>> state() const
    {
        const pdn_equations_sizes sizes = this->sizes();
        std::vector<double> motions(sizes.motions), own(sizes.own_unknowns);
        detail::check(pdn_equations_state(get(), motions.data(), motions.size(), own.data(),
                                          own.size()));
        return {std::move(motions), std::move(own)};
    }
    void set_state(const std::vector<double> &motions, const std::vector<double> &own_unknowns)
    {
        detail::check(pdn_equations_set_state(get(), motions.data(), motions.size(),
                                              own_unknowns.data(), own_unknowns.size()));
    }
    std::vector<double> residual()
    {
        std::vector<double> residual(sizes().size);
        detail::check(pdn_equations_residual(get(), residual.data(), residual.size()));
        return residual;
    }
    void linearise()
    {
        detail::check(pdn_equations_linearise(get()));
    }
    std::vector<double> product(const std::vector<double> &x)
    {
        std::vector<double> out(x.size());
        detail::check(pdn_equations_product(get(), x.data(), out.data(), x.size()));
        return out;
    }
    std::vector<double> transposed_product(const std::vector<double> &x)
    {
        std::vector<double> out(x.size());
        detail::check(pdn_equations_transposed_product(get(), x.data(), out.data(), x.size()));
        return out;
    }
    /** The product with what multiplies a power of mu, 1 or 2, for disturbances exp(mu t). */
    std::vector<double> power_product(std::int32_t power, const std::vector<double> &x)
    {
        std::vector<double> out(x.size());
        detail::check(pdn_equations_power_product(get(), power, x.data(), out.data(), x.size()));
        return out;
    }
    /** Factors the preconditioner; false if it is singular. */
    bool factor(const std::vector<double> &right_side)
    {
        return detail::number<std::int32_t>([&](std::int32_t *regular) {
                   return pdn_equations_factor(get(), right_side.data(), right_side.size(),
                                               regular);
               }) != 0;
    }
    std::vector<double> precondition(const std::vector<double> &x)
    {
        std::vector<double> out(x.size());
        detail::check(pdn_equations_precondition(get(), x.data(), out.data(), x.size()));
        return out;
    }
    /** What an increment leaves of constraints by their compliance; empty if they have none. */
    std::vector<double> compliance(const std::vector<double> &increment)
    {
        std::vector<double> out(increment.size());
        const auto compliant = detail::number<std::int32_t>([&](std::int32_t *flag) {
            return pdn_equations_compliance(get(), increment.data(), out.data(), out.size(), flag);
        });
        return compliant != 0 ? out : std::vector<double>();
    }
    void update(const std::vector<double> &increment, double step = 1)
    {
        detail::check(pdn_equations_update(get(), increment.data(), increment.size(), step));
    }
    /** Largest motion, and largest relative change of an own unknown. */
    std::array<double, 2> norms(const std::vector<double> &increment) const
    {
        std::array<double, 2> norms{};
        detail::check(pdn_equations_norms(get(), increment.data(), increment.size(), &norms[0],
                                          &norms[1]));
        return norms;
    }
    /** The present state as a solution, on one rank or, for -1, on all; none on the others. */
    std::unique_ptr<Solution> solution(Outcome outcome, std::int32_t root = -1) const
    {
        auto handle = detail::make<pdn_solution>([&](pdn_solution **out) {
            return pdn_equations_solution(get(), root, detail::c(outcome), out);
        });
        return handle ? std::make_unique<Solution>(handle.release(), kept_) : nullptr;
    }

  private:
    detail::Kept kept_;
    std::unique_ptr<pdn_equations, detail::Free> handle_;
};

/** Options of solve_shooting, with the fields of ::pdn_shooting_options and these in place of
 * pointers. */
struct ShootingOptions : pdn_shooting_options {
    ShootingOptions()
    {
        pdn_shooting_options_init(this, sizeof(pdn_shooting_options));
    }
    /** Start the march from this solution. */
    const Solution *initial = nullptr;
    Progress progress;
};

/** Finds the periodic response by Newton's method on the period map of march; the solution is a
 * trajectory. */
inline Solution solve_shooting(const Model &model, double period,
                               const ShootingOptions &options = {})
{
    pdn_shooting_options plain = options;
    plain.initial = detail::initial(options.initial);
    detail::Watch watch(options.progress, plain);
    auto handle = detail::make<pdn_solution>(
        [&](pdn_solution **out) { return pdn_solve_shooting(model.get(), period, &plain, out); });
    watch.rethrow();
    return Solution(handle.release(), model.kept());
}

/** Options of solve_stability, with the fields of ::pdn_stability_options and this in place of
 * pointers. */
struct StabilityOptions : pdn_stability_options {
    StabilityOptions()
    {
        pdn_stability_options_init(this, sizeof(pdn_stability_options));
    }
    Progress progress;
};

/** Mode of a multiplier at a node over the period, along the node's own axes. */
struct FloquetMode {
    Series<6> real, imaginary;
};

/** Floquet multipliers of a periodic solution, the largest first. */
class Stability
{
  public:
    /** Takes over a handle of periodyn.h. */
    explicit Stability(pdn_stability *handle) : handle_(handle)
    {
    }
    /** The handle, for functions of periodyn.h; NULL if moved from. */
    const pdn_stability *get() const noexcept
    {
        return handle_.get();
    }
    Outcome outcome() const
    {
        const std::int32_t outcome = pdn_stability_outcome(get());
        detail::check(outcome);
        return static_cast<Outcome>(outcome);
    }
    Verdict verdict() const
    {
        std::int32_t out = 0;
        detail::check(pdn_stability_verdict(get(), &out, nullptr));
        return static_cast<Verdict>(out);
    }
    /** Angular frequency up to which the verdict holds; infinite if all multipliers are known. */
    double frequency_limit() const
    {
        std::int32_t verdict = 0;
        double out = 0;
        detail::check(pdn_stability_verdict(get(), &verdict, &out));
        return out;
    }
    /** Number of multipliers that are known. */
    std::size_t count() const
    {
        return detail::number<std::size_t>(
            [&](std::size_t *out) { return pdn_stability_count(get(), out, nullptr); });
    }
    /** Number of multipliers that the system has. */
    std::size_t states() const
    {
        std::size_t count = 0, states = 0;
        detail::check(pdn_stability_count(get(), &count, &states));
        return states;
    }
    pdn_multiplier multiplier(std::int32_t number) const
    {
        pdn_multiplier out;
        pdn_multiplier_init(&out, sizeof out);
        detail::check(pdn_stability_get(get(), number, &out));
        return out;
    }
    /** Times of modes. */
    std::vector<double> times() const
    {
        std::size_t steps = 0;
        detail::check(pdn_stability_times(get(), nullptr, 0, &steps));
        std::vector<double> out(steps);
        detail::check(pdn_stability_times(get(), out.data(), steps, nullptr));
        return out;
    }
    FloquetMode mode(std::int32_t number, std::int32_t node) const
    {
        std::size_t steps = 0;
        detail::check(pdn_stability_times(get(), nullptr, 0, &steps));
        FloquetMode out{Series<6>(steps), Series<6>(steps)};
        detail::check(pdn_stability_shape(get(), number, node, steps, detail::flat(out.real),
                                          detail::flat(out.imaginary)));
        return out;
    }
    std::string report() const
    {
        outcome(); // throws if there is nothing to report
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_stability_report(get(), buffer, capacity);
        });
    }

  private:
    std::unique_ptr<pdn_stability, detail::Free> handle_;
};

inline std::vector<std::complex<double>>
Sensitivities::of_multiplier(const Solution &solution, const Stability &stability,
                             std::int32_t number, const Conditions *conditions,
                             const SensitivityOptions &options) const
{
    std::vector<double> re(parameters_), im(parameters_);
    detail::check(pdn_solution_multiplier_sensitivities(
        solution.get(), get(), stability.get(), number, conditions ? conditions->get() : nullptr,
        &options, re.data(), im.data(), parameters_));
    std::vector<std::complex<double>> derivatives;
    for (std::size_t i = 0; i < parameters_; ++i) {
        derivatives.emplace_back(re[i], im[i]);
    }
    return derivatives;
}

/** Finds what small disturbances of a periodic solution are multiplied by in a period. */
inline Stability solve_stability(const Solution &solution, const StabilityOptions &options = {})
{
    pdn_stability_options plain = options;
    detail::Watch watch(options.progress, plain);
    auto handle = detail::make<pdn_stability>(
        [&](pdn_stability **out) { return pdn_solve_stability(solution.get(), &plain, out); });
    watch.rethrow();
    return Stability(handle.release());
}

/** Options of solve_modes, with the fields of ::pdn_modes_options and this in place of the pointer.
 */
struct ModesOptions : pdn_modes_options {
    ModesOptions()
    {
        pdn_modes_options_init(this, sizeof(pdn_modes_options));
    }
    /** The equilibrium, and who is told of the iterations. */
    StaticOptions equilibrium;
};

/** Shape of a mode: displacement and rotation of each node, along its own axes. */
struct Shape {
    Series<6> real, imaginary;
};

/** Natural modes and damped eigenvalues about an equilibrium, counted from 0. */
class Modes
{
  public:
    /** Takes over a handle of periodyn.h; keeps the functions of signals that it may call. */
    explicit Modes(pdn_modes *handle, detail::Kept kept = {})
        : kept_(std::move(kept)), handle_(handle)
    {
    }
    /** The handle, for functions of periodyn.h; NULL if moved from. */
    const pdn_modes *get() const noexcept
    {
        return handle_.get();
    }
    /** Of the equilibrium; unless it converged there are no modes. */
    Outcome outcome() const
    {
        const std::int32_t outcome = pdn_modes_outcome(get());
        detail::check(outcome);
        return static_cast<Outcome>(outcome);
    }
    bool converged() const
    {
        return outcome() == Outcome::converged;
    }
    std::string report() const
    {
        outcome(); // throws if there is nothing to report
        return detail::text([&](char *buffer, std::size_t capacity) {
            return pdn_modes_report(get(), buffer, capacity);
        });
    }
    std::int32_t count() const
    {
        return detail::number<std::int32_t>(
            [&](std::int32_t *out) { return pdn_modes_count(get(), out, nullptr); });
    }
    /** Whether all that were wanted were found, or all that there are. */
    bool complete() const
    {
        std::int32_t count = 0, complete = 0;
        detail::check(pdn_modes_count(get(), &count, &complete));
        return complete != 0;
    }
    /** Eigenvalue, frequency and damping. */
    pdn_mode mode(std::int32_t mode) const
    {
        pdn_mode out;
        pdn_mode_init(&out, sizeof out);
        detail::check(pdn_modes_get(get(), mode, &out));
        return out;
    }
    Shape shape(std::int32_t mode, Ids nodes) const
    {
        Shape out{Series<6>(nodes.size()), Series<6>(nodes.size())};
        detail::check(pdn_modes_shape(get(), mode, nodes.data(), nodes.size(),
                                      detail::flat(out.real), detail::flat(out.imaginary)));
        return out;
    }
    /** The motion in a mode. */
    Solution motion(std::int32_t mode, double amplitude) const
    {
        auto handle = detail::make<pdn_solution>(
            [&](pdn_solution **out) { return pdn_modes_motion(get(), mode, amplitude, out); });
        return Solution(handle.release(), kept_);
    }
    Solution equilibrium() const
    {
        auto handle = detail::make<pdn_solution>(
            [&](pdn_solution **out) { return pdn_modes_equilibrium(get(), out); });
        return Solution(handle.release(), kept_);
    }

  private:
    detail::Kept kept_; // outlives the handle
    std::unique_ptr<pdn_modes, detail::Free> handle_;
};

/** Finds an equilibrium, and the modes of small motions about it. */
inline Modes solve_modes(const Model &model, const ModesOptions &options = {})
{
    pdn_static_options equilibrium = options.equilibrium;
    equilibrium.initial = detail::initial(options.equilibrium.initial);
    detail::Watch watch(options.equilibrium.progress, equilibrium);
    pdn_modes_options plain = options;
    plain.equilibrium = &equilibrium;
    auto handle = detail::make<pdn_modes>(
        [&](pdn_modes **out) { return pdn_solve_modes(model.get(), &plain, out); });
    watch.rethrow();
    return Modes(handle.release(), model.kept());
}

/** Quantities of solutions at many times, to be written as CSV. Without labels columns have names
 * of their own. */
class Table
{
  public:
    using Id = std::int32_t;

    explicit Table(Reals times)
        : handle_(detail::make<pdn_table>(
              [&](pdn_table **out) { return pdn_table_new(times.data(), times.size(), out); }))
    {
    }
    /** The handle, for functions of periodyn.h; NULL if moved from. */
    pdn_table *get() const noexcept
    {
        return handle_.get();
    }
    /** A quantity, or one of its components. */
    void add(const Solution &solution, const Quantity &quantity, const std::string &label = {})
    {
        detail::check(pdn_table_add_quantity(get(), solution.get(), &quantity, c(label)));
    }
    /** Values of your own, one for each time. */
    void add_values(const std::string &label, Reals values)
    {
        detail::check(pdn_table_add_values(get(), label.c_str(), values.data(), values.size()));
    }
    void write_csv(const std::string &path) const
    {
        detail::check(pdn_table_write_csv(get(), path.c_str()));
    }

  private:
    static const char *c(const std::string &label)
    {
        return label.empty() ? nullptr : label.c_str();
    }

    std::unique_ptr<pdn_table, detail::Free> handle_;
};

/** A motion at many times; velocities along the moving axes. */
struct Motion {
    Series<3> positions;
    Series<9> rotations;
    Series<6> velocities;
    Series<6> accelerations;
};

/** Velocities and accelerations at the grid points, and their derivatives by the motions. */
struct GridKinematics {
    Series<6> velocities;
    Series<6> accelerations;
    /** 6 N x 6 N, column by column; empty if not wanted. */
    std::vector<double> velocity_tangent, acceleration_tangent;
};

namespace detail
{
inline void check_motion(const Series<3> &positions, const Series<9> &rotations)
{
    if (positions.size() != rotations.size()) {
        throw error(PDN_ERR_SIZE, "rotations: expected as many as positions");
    }
}
} // namespace detail

/** Interpolates a periodic motion given at N equispaced times. */
inline Motion interpolate_motion(double period, const Series<3> &positions,
                                 const Series<9> &rotations, Reals times)
{
    detail::check_motion(positions, rotations);
    const std::size_t count = times.size();
    Motion out{Series<3>(count), Series<9>(count), Series<6>(count), Series<6>(count)};
    detail::check(pdn_motion_interpolate(
        period, detail::flat(positions), detail::flat(rotations), positions.size(), times.data(),
        count, detail::flat(out.positions), detail::flat(out.rotations),
        detail::flat(out.velocities), detail::flat(out.accelerations)));
    return out;
}

/** Differentiates a periodic motion at its own grid points. */
inline GridKinematics motion_grid_kinematics(double period, const Series<3> &positions,
                                             const Series<9> &rotations, bool tangents = false)
{
    detail::check_motion(positions, rotations);
    const std::size_t points = positions.size();
    const std::size_t entries = tangents ? 36 * points * points : 0;
    GridKinematics out{Series<6>(points), Series<6>(points), std::vector<double>(entries),
                       std::vector<double>(entries)};
    detail::check(
        pdn_motion_grid_kinematics(period, detail::flat(positions), detail::flat(rotations), points,
                                   detail::flat(out.velocities), detail::flat(out.accelerations),
                                   tangents ? out.velocity_tangent.data() : nullptr,
                                   tangents ? out.acceleration_tangent.data() : nullptr));
    return out;
}

} // namespace periodyn

#if defined(PERIODYN_EIGEN)
#include <Eigen/Core>
#endif
#if defined(EIGEN_WORLD_VERSION)
namespace periodyn
{

/** The entries of a small matrix or vector, column by column: what functions above take. */
template <class Derived>
std::array<double, Derived::RowsAtCompileTime * Derived::ColsAtCompileTime>
array(const Eigen::MatrixBase<Derived> &matrix)
{
    std::array<double, Derived::RowsAtCompileTime * Derived::ColsAtCompileTime> out;
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
        for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
            out[static_cast<std::size_t>(column * matrix.rows() + row)] = matrix(row, column);
        }
    }
    return out;
}

/** A series as a matrix with one column for each time. */
template <std::size_t C>
Eigen::Map<const Eigen::Matrix<double, C, Eigen::Dynamic>> view(const Series<C> &series)
{
    return {detail::flat(series), static_cast<Eigen::Index>(C),
            static_cast<Eigen::Index>(series.size())};
}

/** Numbers as a vector. */
inline Eigen::Map<const Eigen::VectorXd> view(const std::vector<double> &numbers)
{
    return {numbers.data(), static_cast<Eigen::Index>(numbers.size())};
}

/** A rotation matrix, or other 3 x 3 matrix. */
inline Eigen::Map<const Eigen::Matrix3d> view(const Matrix3 &matrix)
{
    return Eigen::Map<const Eigen::Matrix3d>(matrix.data());
}

} // namespace periodyn
#endif

#endif // PERIODYN_HPP
