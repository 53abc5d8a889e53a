! Periodyn for Fortran 2018: periodic response of flexible multibody systems.
!
! Compile this file with your program. It is written by script/fortran_interface from periodyn.h; do
! not edit it. It has two modules:
!
!   periodyn_c   the functions, structs and constants of periodyn.h, under their names; its
!                documentation holds. Pointers that may be NULL are optional arguments; texts end
!                with c_null_char.
!   periodyn     the same as derived types that free themselves, with optional stat and errmsg; it
!                passes periodyn_c on.

module periodyn_c
    use, intrinsic :: iso_c_binding
    implicit none
    public

$constants

$structs

    ! Functions of the caller; they are handed over as c_funloc(function).
    abstract interface
$callbacks
    end interface

    interface
$functions
    end interface
end module periodyn_c

module periodyn
$renamed
    use, intrinsic :: iso_fortran_env, only: error_unit
    implicit none
    public
    private :: report, fits, nodes_of, raw_of, text_at, error_unit

    ! In every procedure: without stat, a failure ends the program with the message. With it, stat
    ! is 0 or the negative status (PDN_ERR_VALUE, ...), and errmsg, blank-padded, tells which
    ! argument was wrong, what was expected and what came; other outputs are then left as they are.
    ! Not converging is no failure, but an outcome of the solution.
    !
    ! Ids and counts are integer(c_int32_t), which is the default integer.

    ! A handle with shared ownership: an assignment makes a second name for the same object, which
    ! is freed when its last variable goes. (Variables of the main program never go; call free, or
    ! use a block.)
    type :: pdn_handle
        type(c_ptr), private :: c = c_null_ptr
        integer, pointer, private :: owners => null()
        procedure(pdn_destroy_fn), pointer, nopass, private :: release_with => null()
    contains
        procedure, public :: free => handle_free
        procedure, public :: handle => handle_raw
        procedure, private :: share
        procedure, private :: adopt
        generic, public :: assignment(=) => share
        final :: handle_finalise
    end type pdn_handle

    ! A function of time, from pdn_constant_signal, pdn_harmonics_signal, ..., with the numbers that
    ! it was given.
    type :: pdn_signal
        private
        type(c_signal) :: raw
        real(c_double), allocatable :: cosines(:), sines(:), samples(:)
    end type pdn_signal

$types

    ! Sets the defaults of a struct.
    interface pdn_init
$initialisers
    end interface pdn_init

$interfaces

$private

contains

    ! Failure ----------------------------------------------------------------------------------

    ! Hands a status on to the caller, with the library's message if it is a failure.
    subroutine report(status, stat, errmsg)
        integer(c_int32_t), intent(in) :: status
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg

        if (present(stat)) stat = status
        if (status == PDN_OK) return
        if (present(errmsg)) errmsg = pdn_last_error()
        if (present(stat)) return
        write (error_unit, '(4a)') 'periodyn: ', pdn_status_name(status), ': ', pdn_last_error()
        error stop 1
    end subroutine report

    ! Whether an array has the shape that it must have; otherwise refuses it. What is negative is
    ! not known, for a reason that the call tells.
    logical function fits(name, found, expected, stat, errmsg)
        character(*), intent(in) :: name
        integer, intent(in) :: found(:), expected(:)
        integer, intent(out), optional :: stat
        character(*), intent(inout), optional :: errmsg
        character(200) :: message

        fits = any(expected < 0) .or. all(found == expected)
        if (fits) return
        write (message, '(2a, *(i0, :, " x "))') name, ': expected the shape ', expected
        write (message(len_trim(message) + 1:), '(a, *(i0, :, " x "))') ', got ', found
        call set_last_error(message)
        call report(PDN_ERR_SIZE, stat, errmsg)
    end function fits

    ! Number of nodes of a model; negative if there is no model.
    integer function nodes_of(model)
        class(pdn_handle), intent(in) :: model

        if (pdn_model_node_count(model%c, nodes_of) /= PDN_OK) nodes_of = -1
    end function nodes_of

    ! Signals ----------------------------------------------------------------------------------

    ! A signal as the library takes it, while it is there.
    impure elemental type(c_signal) function raw_of(signal)
        type(pdn_signal), intent(in), target :: signal

        raw_of = signal%raw
        if (allocated(signal%cosines)) raw_of%cosines = c_loc(signal%cosines)
        if (allocated(signal%sines)) raw_of%sines = c_loc(signal%sines)
        if (allocated(signal%samples)) raw_of%samples = c_loc(signal%samples)
    end function raw_of

    ! Quantities -------------------------------------------------------------------------------

    ! What is asked of a solution, of one of the kinds PDN_NODE_POSITION, ..., of a node, joint,
    ! beam element or force; other fields may then be set.
    function pdn_quantity_of(kind, object, component, frame, node, branch, station) &
        result(quantity)
        integer(c_int32_t), intent(in) :: kind, object
        integer(c_int32_t), intent(in), optional :: component, frame, node, branch
        real(c_double), intent(in), optional :: station
        type(pdn_quantity) :: quantity

        call pdn_init(quantity)
        quantity%kind = kind
        quantity%object = object
        if (present(component)) quantity%component = component
        if (present(frame)) quantity%frame = frame
        if (present(node)) quantity%node = node
        if (present(branch)) quantity%branch = branch
        if (present(station)) quantity%station = station
    end function pdn_quantity_of

    ! Texts ---------------------------------------------------------------------------------------

    function text_at(pointer) result(text)
        type(c_ptr), intent(in) :: pointer
        character(:), allocatable :: text
        character(kind=c_char), pointer :: characters(:)

        call c_f_pointer(pointer, characters, [huge(1)])
        text = ''
        do while (characters(len(text) + 1) /= c_null_char)
            text = text//characters(len(text) + 1)
        end do
    end function text_at

    ! Handles ----------------------------------------------------------------------------------

    ! Gives up the object; frees it if this was its last variable.
    subroutine handle_free(self)
        class(pdn_handle), intent(inout) :: self

        if (associated(self%owners)) then
            self%owners = self%owners - 1
            if (self%owners == 0) then
                deallocate (self%owners)
                call self%release_with(self%c)
            end if
        end if
        self%c = c_null_ptr
        self%owners => null()
    end subroutine handle_free

    subroutine handle_finalise(self)
        type(pdn_handle), intent(inout) :: self

        call self%free()
    end subroutine handle_finalise

    ! The handle for procedures of periodyn_c; null if there is none.
    type(c_ptr) function handle_raw(self)
        class(pdn_handle), intent(in) :: self

        handle_raw = self%c
    end function handle_raw

    ! Takes over a handle of the library, if it gave one, in place of what was held.
    subroutine adopt(self, c, release_with)
        class(pdn_handle), intent(inout) :: self
        type(c_ptr), intent(in) :: c
        procedure(pdn_destroy_fn) :: release_with

        if (.not. c_associated(c)) return
        call self%free()
        self%c = c
        self%release_with => release_with
        allocate (self%owners, source=1)
    end subroutine adopt

    subroutine share(left, right)
        class(pdn_handle), intent(inout) :: left
        class(pdn_handle), intent(in) :: right

        if (.not. same_type_as(left, right)) then
            call set_last_error('assignment: expected objects of the same type')
            call report(PDN_ERR_VALUE)
        end if
        if (associated(right%owners)) right%owners = right%owners + 1
        call left%free()
        left%c = right%c
        left%owners => right%owners
        left%release_with => right%release_with
    end subroutine share

    ! The functions of periodyn.h --------------------------------------------------------------

$procedures
end module periodyn
