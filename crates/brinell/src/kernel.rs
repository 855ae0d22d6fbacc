//! Which processor instructions the simulation's arithmetic uses, and the environment variable that chooses them.
//!
//! A process has one kernel for every simulation in it: the one that [`SETTING`] names, or the fastest that the
//! processor can run. The kernels compute the same equations and differ in round-off alone.

use std::sync::LazyLock;

/// Environment variable that chooses the kernel of a process by its [`Kernel::name`]. Unset or empty: the fastest. It
/// is read once, when the first model is made.
pub const SETTING: &str = "BRINELL_KERNEL";

/// How the equations of motion, the integrator's sums and the sensor's filters are computed. [`Kernel::Plain`] and
/// [`Kernel::Portable`] round every product on x86-64, the others fuse products with sums.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kernel {
    /// One roller at a time, with the standard library's sine, exponential and tanh. Several times slower than the
    /// others.
    Plain,
    /// All processors of a target that have it compute the same bits: AVX2 on x86-64, where every product is rounded and a
    /// processor without AVX2 has [`Kernel::Plain`] alone; NEON on 64-bit Arm.
    Portable,
    /// AVX2 and FMA.
    Avx2,
    /// AVX-512.
    Avx512,
}

/// What is wrong with the value of [`SETTING`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{SETTING} = {value:?}: {requirement}")]
pub struct KernelError {
    /// The value.
    pub value: String,
    /// What it must be.
    pub requirement: String,
}

static CHOICE: LazyLock<Result<Kernel, KernelError>> = LazyLock::new(|| {
    let value = std::env::var_os(SETTING).unwrap_or_default();
    Kernel::named(&value.to_string_lossy())
});

impl Kernel {
    /// Every kernel, the slowest first.
    pub const ALL: [Self; 4] = [Self::Plain, Self::Portable, Self::Avx2, Self::Avx512];

    /// The word that [`SETTING`] and results use: `plain`, `portable`, `avx2` or `avx512`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Portable => "portable",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// Whether this processor can run it.
    pub fn is_there(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        {
            let rounded = is_x86_feature_detected!("avx2");
            let avx2 = rounded && is_x86_feature_detected!("fma");
            let avx512 = avx2
                && is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl");
            match self {
                Self::Plain => true,
                Self::Portable => rounded,
                Self::Avx2 => avx2,
                Self::Avx512 => avx512,
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            matches!(self, Self::Plain | Self::Portable)
        }
    }

    /// The widest that this processor can run.
    pub fn fastest() -> Self {
        Self::ALL.into_iter().rev().find(|k| k.is_there()).unwrap_or(Self::Plain)
    }

    /// The kernel of a value of [`SETTING`]; the fastest where it is empty.
    ///
    /// # Errors
    /// Where it is no kernel's name, or this processor cannot run that kernel.
    pub fn named(value: &str) -> Result<Self, KernelError> {
        if value.is_empty() {
            return Ok(Self::fastest());
        }
        if let Some(kernel) = Self::ALL.into_iter().find(|k| k.name() == value)
            && kernel.is_there()
        {
            return Ok(kernel);
        }
        let there: Vec<&str> = Self::ALL.into_iter().filter(|k| k.is_there()).map(Self::name).collect();
        let what = match Self::ALL.iter().any(|k| k.name() == value) {
            true => "this processor lacks its instructions",
            false => "no such kernel",
        };
        let there = there.join(", ");
        Err(KernelError {
            value: value.to_owned(),
            requirement: format!(
                "{what}; this environment variable must be one of {there} here, or unset for the fastest"
            ),
        })
    }

    /// The kernel of this process.
    ///
    /// # Errors
    /// As [`Kernel::named`], for the value of [`SETTING`]. Making a model fails with the same words.
    pub fn chosen() -> Result<Self, &'static KernelError> {
        match &*CHOICE {
            Ok(kernel) => Ok(*kernel),
            Err(error) => Err(error),
        }
    }

    /// The kernel of this process for code that a model is needed to reach: no model is made where [`SETTING`] is
    /// wrong.
    #[inline]
    pub(crate) fn in_use() -> Self {
        match &*CHOICE {
            Ok(kernel) => *kernel,
            Err(_) => Self::Portable,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prop_a_kernel_that_is_not_there_is_refused_and_never_replaced() {
        for kernel in Kernel::ALL {
            match Kernel::named(kernel.name()) {
                Ok(found) => assert!(found == kernel && kernel.is_there()),
                Err(error) => {
                    assert!(!kernel.is_there());
                    assert!(error.requirement.starts_with("this processor lacks"));
                }
            }
        }
        assert_eq!(Kernel::named(""), Ok(Kernel::fastest()));
        for unknown in ["AVX2", "avx2 ", "sse2", "fastest"] {
            let words = Kernel::named(unknown).unwrap_err().to_string();
            let expected = format!("BRINELL_KERNEL = {unknown:?}: no such kernel; ");
            assert!(words.starts_with(&expected), "{words}");
            assert!(words.contains("plain, portable"), "{words}");
        }
    }
}
