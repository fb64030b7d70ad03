//! `slideway help questions`

/// Which command and which kind of model for which question: the short form of the page "Which question, which
/// command" of the book.
pub(crate) const TEXT: &str = "\
Which command and which kind of model answers which question

Does it jam?                       solve; limits --vary mu
    Prescribe the motion with a DRIVE: no solution means that no force moves it.
What does this load do?            solve; simulate
    Give the LOAD and masses: the answer is whether motion speeds up or slows down. There is a
    solution even where the push does not suffice: slowing down is the sign of it.
Does it start?                     hold --load push
Does it hold?                      hold; hold --vary mu_static=0..0.5; map --colour-by hold
    Statics: neither masses nor drives are needed.
Is it self-locking?                hold --load W; hold --load W --vary mu_static
    The name gravity stands for all weights.
How much force does it need?       drive
How long must the guide be?        size --vary L --margin 2
    Or with --max-effort, --max-normal-force, --max-pressure or --min-efficiency;
    with a drive.
Up to which friction?              limits --vary mu
    With a drive: where it jams. With a load: where it no longer speeds up but slows down.
Which of two rails carries?        solve
    Give play, stiffness and misalignment of the contacts.
How does it move over time?        simulate
Where in a plane of quantities?    map --colour-by solutions, or motion, or hold

A drive asks whether it can be moved at all, by whatever force that takes; a load asks what that
load does. The same push as a drive, and as a load:

    [drives.push]
    coordinate = \"z\"
    force = { at = \"peg.top\", direction = \"-90 deg\" }

    [loads.push]
    type = \"force\"
    at = \"peg.top\"
    components = [0, \"-50 N\"]";
