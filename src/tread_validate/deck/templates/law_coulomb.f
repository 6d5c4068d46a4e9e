c
c     Kinetic friction coefficient: a constant.
c     props(1) static coefficient, props(2) kinetic coefficient
c
      function fricmu(nProps, props, press, speed)
      include 'vaba_param.inc'
      dimension props(nProps)
      fricmu = props(2)
c     neither pressure (MPa) nor slip speed (mm/s) enters
      if (press .lt. -1.d30 .and. speed .lt. -1.d30) fricmu = 0.d0
      return
      end
