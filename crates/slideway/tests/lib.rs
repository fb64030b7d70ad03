//! Nothing: a package has to have a library. The tests are a package of their own, so that they are not optimised as
//! the library is: compiling them took half as long as compiling it.
