//! `slideway help questions`

/// Which command and which kind of model for which question: the short form of the page "Which question, which
/// command" of the book.
pub(crate) const TEXT: &str = "\
Which command and which kind of model answers which question

Does it jam?                       solve; limits --vary mu
    Prescribe the motion with a DRIVE: no solution means that no force moves it.
What does this load do?            solve; simulate
    Give the LOAD and masses: the answer is whether the motion speeds up or
    slows down. There is a solution even where the push does not suffice: then
    the motion slows down.
Does it start?                     hold --load push
Does it hold?                      hold; hold --vary mu_static=0..0.5
    Statics: neither masses nor drives are needed. For two quantities:
    map --colour-by hold. For a safety factor: size --against hold --margin 1.5
Does it tip, or lift off?          hold; solve; map --colour-by motion
    Joints of the types corner_on_face, block_on_face and disc_on_face may open.
Is it self-locking?                hold --load W --vary mu_static
    The name gravity stands for all weights.
How much force does it need?       drive
How long must the guide be?        size --vary L
    With a safety factor: --margin 2. Or with --max-effort, --max-normal-force,
    --max-pressure or --min-efficiency. All of these need a drive.
Up to which friction?              limits --vary mu
    With a drive: where it jams. With a load: where it slows down instead of
    speeding up.
Which of two rails carries?        solve
    Give play, stiffness and misalignment of the contacts.
How does it move over time?        simulate
How do two quantities matter?      map --colour-by solutions, motion or hold

A drive asks whether it can be moved at all, by whatever force that takes. A
load asks what that load does. The same push as a drive, and as a load:

    [drives.push]
    coordinate = \"z\"
    force = { at = \"peg.top\", direction = \"-90 deg\" }

    [loads.push]
    type = \"force\"
    at = \"peg.top\"
    components = [0, \"-50 N\"]

How far an answer can be trusted:

    Proven             nothing is missed, rounding included
    Computed           every case was examined, in rounded numbers
    Sampled every ..   values between were not tried
    Not decided        take the unsafe side, or ask beside it";
