// Stores a reader's choices in this browser, for all pages. Without storage the choices are just not kept.

const prefix = 'sinew: ';

export function remember(what, value) {
  try {
    localStorage.setItem(prefix + what, value);
  } catch {
    // Private windows and some policies forbid storage.
  }
}

// Returns a stored choice; null if there was no choice.
export function recall(what) {
  try {
    return localStorage.getItem(prefix + what);
  } catch {
    return null;
  }
}
