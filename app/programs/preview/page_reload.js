'use strict';
setInterval(() => {
  const busy = document.hidden || [...document.querySelectorAll('audio')].some((sound) => !sound.paused);
  if (!busy) {
    history.replaceState(null, '', document.documentElement.keep());
    location.reload();
  }
}, 2000);
