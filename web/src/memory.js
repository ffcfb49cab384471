// This keeps what a reader chose in this browser, for all pages. A browser that keeps nothing is no trouble.

const prefix = 'sinew: ';

export function remember(what, value) {
  try {
    localStorage.setItem(prefix + what, value);
  } catch {
    // private windows, and pages that a policy keeps from it
  }
}

// null: nothing was chosen.
export function recall(what) {
  try {
    return localStorage.getItem(prefix + what);
  } catch {
    return null;
  }
}
