//! What `brinell --version` says.

use brinell::kernel::Kernel;
use std::sync::LazyLock;

/// The commit that this crate was built from, where its build could tell.
pub const COMMIT: Option<&str> = option_env!("BRINELL_BUILT_FROM");

/// Version, the commit that was built and the kernel of this processor, a line each.
pub(crate) fn long() -> &'static str {
    static TEXT: LazyLock<String> = LazyLock::new(|| {
        let commit = COMMIT.unwrap_or("unknown");
        let kernel = match Kernel::chosen() {
            Ok(kernel) => kernel.name().to_owned(),
            Err(error) => error.to_string(),
        };
        format!("{}\ncommit {commit}\nkernel {kernel}", brinell::VERSION)
    });
    &TEXT
}
